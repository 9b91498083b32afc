#include "planner/automaton/yaml_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

namespace hlc {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }

}  // namespace

std::string shortest_text(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

std::string quoted_yaml(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

bool has_control_characters(const std::string& text) {
  return std::ranges::any_of(text, is_control);
}

std::string one_line(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  const auto is_inside_character = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;  // UTF-8: 10xxxxxx
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (i >= kLongest && !is_inside_character(c)) return result + "...";
    if (c == '\n') {
      result += "\\n";
    } else if (is_control(c)) {
      std::array<char, 5> escaped{};
      std::snprintf(escaped.data(), escaped.size(), "\\x%02x", static_cast<unsigned char>(c));
      result += escaped.data();
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace hlc
