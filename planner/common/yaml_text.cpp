#include "planner/common/yaml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

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

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
    } else if (is_control(c)) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result;
}

std::string one_line(const std::string& text, std::size_t longest) {
  const auto is_inside_character = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;  // UTF-8: 10xxxxxx
  };
  std::size_t end = longest;
  while (end < text.size() && is_inside_character(text[end])) ++end;
  return end < text.size() ? escaped(text.substr(0, end)) + "..." : escaped(text);
}

}  // namespace hlc
