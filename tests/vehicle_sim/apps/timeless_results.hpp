#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/common/csv.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::test {

/// The first line ("campaign") and the rows ("runs") of the folder's runs.jsonl, by run; of several
/// rows of a run the last one.
[[nodiscard]] inline nlohmann::json rows_of(const std::filesystem::path& folder) {
  const std::vector<std::string> lines = split(read_file(folder / "runs.jsonl"), '\n');
  std::map<std::size_t, nlohmann::json> by_run;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].empty()) continue;
    const nlohmann::json row = nlohmann::json::parse(lines[i]);
    by_run[row["run"].get<std::size_t>()] = row;
  }
  nlohmann::json rows{{"campaign", nlohmann::json::parse(lines.front())},
                      {"runs", nlohmann::json::array()}};
  for (const auto& [run, row] : by_run) rows["runs"].push_back(row);
  return rows;
}

[[nodiscard]] inline bool is_of_a_clock(const std::string& figure) {
  return figure.starts_with("planning_") || figure.starts_with("wall_") ||
         figure.starts_with("step_p99") || figure.starts_with("step_max") ||
         figure == "exceeding_step_share" || figure == "realtime_factor";
}

/// The same without what a clock measured, and the hashes of the rows.
[[nodiscard]] inline nlohmann::json timeless(nlohmann::json rows) {
  const auto drop = [](nlohmann::json& object) {
    std::vector<std::string> names;
    for (const auto& [name, value] : object.items()) {
      if (is_of_a_clock(name)) names.push_back(name);
    }
    for (const std::string& name : names) object.erase(name);
  };
  for (auto& run : rows["runs"]) {
    run.erase("check");
    drop(run);
    drop(run["figures"]);
    for (auto& vehicle : run["vehicles"]) drop(vehicle);
  }
  return rows;
}

/// The fields of a CSV file, row by row, without the columns that a clock filled.
[[nodiscard]] inline std::vector<std::vector<std::string>> timeless_table(
    const std::filesystem::path& file) {
  const CsvTable table(file);
  std::vector<std::vector<std::string>> rows(table.size() + 1);
  for (std::size_t column = 0; column < table.columns().size(); ++column) {
    if (is_of_a_clock(table.columns()[column])) continue;
    rows[0].push_back(table.columns()[column]);
    for (std::size_t row = 0; row < table.size(); ++row) {
      rows[row + 1].push_back(table.text(row, column));
    }
  }
  return rows;
}

}  // namespace hlc::test
