#include "planner/apps/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace hlc::apps {
namespace {

constexpr std::size_t kFewestColumns = 40;

/// Characters, not bytes, of UTF-8.
std::size_t length_of(const std::string& word) {
  return static_cast<std::size_t>(std::ranges::count_if(
      word, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

void append_wrapped(const std::string& line, std::size_t columns, std::size_t indent,
                    std::string& text) {
  const std::string begin(indent, ' ');
  if (line.starts_with("  ")) {
    text += begin + line + '\n';
    return;
  }
  std::istringstream words(line);
  std::size_t used = 0;
  for (std::string word; words >> word;) {
    const std::size_t length = length_of(word);
    if (used > 0 && used + 1 + length > columns) {
      text += '\n';
      used = 0;
    }
    text += used == 0 ? begin : " ";
    used += (used == 0 ? indent : 1) + length;
    text += word;
  }
  text += '\n';
}

}  // namespace

std::size_t columns_of(int descriptor) {
  winsize size{};
  if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    return std::max<std::size_t>(size.ws_col, kFewestColumns);
  }
  const char* const variable = std::getenv("COLUMNS");
  const long columns = variable == nullptr ? 0 : std::strtol(variable, nullptr, 10);
  return columns <= 0 ? kPlainColumns : std::max(static_cast<std::size_t>(columns), kFewestColumns);
}

std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) append_wrapped(line, columns, indent, result);
  return result;
}

}  // namespace hlc::apps
