#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hlc::campaign {

/// "| a | b |" with the line feed.
[[nodiscard]] inline std::string markdown_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += (cell.empty() ? "" : " ") + cell + " |";
  return row + "\n";
}

/// The row of the titles and the rule below it.
[[nodiscard]] inline std::string markdown_heading(const std::vector<std::string>& titles) {
  std::string rule = "|";
  for (std::size_t i = 0; i < titles.size(); ++i) rule += "---|";
  return markdown_row(titles) + rule + "\n";
}

}  // namespace hlc::campaign
