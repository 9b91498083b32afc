#include "planner/apps/fitted_table.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "planner/apps/terminal.hpp"

namespace hlc::apps {
namespace {

using Line = std::vector<std::string>;  ///< characters of UTF-8

constexpr std::size_t kHanging = 4;

Line characters_of(const std::string& text) {
  Line line;
  for (const char byte : text) {
    if ((static_cast<unsigned char>(byte) & 0xC0U) != 0x80U || line.empty()) line.emplace_back();
    line.back() += byte;
  }
  return line;
}

bool is_blank(const Line& line, std::size_t at) { return at >= line.size() || line[at] == " "; }

std::size_t width_of(const std::vector<Line>& block) {
  std::size_t width = 0;
  for (const Line& line : block) width = std::max(width, line.size());
  return width;
}

/// Without blanks at the end.
std::string text_of(const Line& line, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t i = begin; i < std::min(end, line.size()); ++i) text += line[i];
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

/// Where all lines are blank, and one has something before.
std::vector<std::size_t> gaps_of(const std::vector<Line>& block) {
  std::vector<std::size_t> gaps;
  bool has_begun = false;
  for (std::size_t at = 0; at < width_of(block); ++at) {
    const bool is_gap =
        std::ranges::all_of(block, [at](const Line& line) { return is_blank(line, at); });
    if (is_gap && has_begun) gaps.push_back(at);
    has_begun = has_begun || !is_gap;
  }
  return gaps;
}

/// Begins and ends of parts that fit; none if the block cannot be cut so.
std::optional<std::vector<std::pair<std::size_t, std::size_t>>> parts_of(
    const std::vector<Line>& block, std::size_t columns) {
  const std::vector<std::size_t> gaps = gaps_of(block);
  if (block.size() < 2 || gaps.empty() || gaps.front() > columns / 2) return std::nullopt;
  std::vector<std::pair<std::size_t, std::size_t>> parts;
  for (std::size_t begin = 0; begin < width_of(block);) {
    const std::size_t limit = begin + columns - (begin == 0 ? 0 : gaps.front());
    std::size_t end = width_of(block);
    if (end > limit) {
      const auto behind = std::ranges::upper_bound(gaps, limit);
      if (behind == gaps.begin() || *(behind - 1) <= std::max(begin, gaps.front())) {
        return std::nullopt;
      }
      end = *(behind - 1);
    }
    parts.emplace_back(begin, end);
    begin = end;
  }
  return parts;
}

std::size_t skip_blanks(const Line& line, std::size_t at) {
  while (at < line.size() && line[at] == " ") ++at;
  return at;
}

std::size_t skip_word(const Line& line, std::size_t at) {
  while (at < line.size() && line[at] != " ") ++at;
  return at;
}

/// Where the words end of which the first begins at `first` and that reach `limit` at most, or the
/// first one alone.
std::size_t end_of_words(const Line& line, std::size_t first, std::size_t limit) {
  std::size_t end = skip_word(line, first);
  while (end < line.size()) {
    const std::size_t next = skip_word(line, skip_blanks(line, end));
    if (next > limit) break;
    end = next;
  }
  return end;
}

void append_broken(const Line& line, std::size_t columns, std::string& text) {
  const std::size_t indent = skip_blanks(line, 0);
  std::size_t end = end_of_words(line, indent, columns);
  text += text_of(line, 0, end) + '\n';
  const std::string begin(std::min(indent + kHanging, columns / 2), ' ');
  for (std::size_t at = skip_blanks(line, end); at < line.size(); at = skip_blanks(line, end)) {
    end = end_of_words(line, at, at + columns - begin.size());
    text += begin + text_of(line, at, end) + '\n';
  }
}

/// The characters from `begin` to `end` of all lines, behind the first `key` ones.
void append_part(const std::vector<Line>& block, std::size_t key, std::size_t begin,
                 std::size_t end, std::string& text) {
  for (const Line& line : block) {
    Line part(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(std::min(key, line.size())));
    part.resize(key, " ");
    for (std::size_t at = begin; at < std::min(end, line.size()); ++at) part.push_back(line[at]);
    text += text_of(part, 0, part.size()) + '\n';
  }
}

void append_block(const std::vector<Line>& block, std::size_t columns, std::string& text) {
  const std::size_t width = width_of(block);
  if (const auto parts = width <= columns ? std::nullopt : parts_of(block, columns)) {
    for (const auto& [begin, end] : *parts) {
      if (begin > 0) text += '\n';
      append_part(block, begin == 0 ? 0 : gaps_of(block).front(), begin, end, text);
    }
    return;
  }
  for (const Line& line : block) append_broken(line, columns, text);
}

/// By a terminal, or by who asks for it.
bool is_limited() { return isatty(STDOUT_FILENO) == 1 || std::getenv("COLUMNS") != nullptr; }

}  // namespace

std::string fitted_table(const std::string& text, std::size_t columns) {
  std::string fitted;
  std::vector<Line> block;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) {
      block.push_back(characters_of(line));
      continue;
    }
    append_block(block, columns, fitted);
    block.clear();
    fitted += '\n';
  }
  append_block(block, columns, fitted);
  return fitted;
}

std::string fitted_table(const std::string& text) {
  return is_limited() ? fitted_table(text, columns_of(STDOUT_FILENO)) : text;
}

std::string fitted_lines(const std::string& text, std::size_t columns) {
  std::string fitted;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    append_broken(characters_of(line), columns, fitted);
  }
  return fitted;
}

std::string fitted_lines(const std::string& text) {
  return is_limited() ? fitted_lines(text, columns_of(STDOUT_FILENO)) : text;
}

}  // namespace hlc::apps
