#include "vehicle_sim/apps/merged_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "planner/common/demand.hpp"
#include "planner/common/text_file.hpp"
#include "vehicle_sim/apps/evaluation_results.hpp"

namespace hlc::apps {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw std::invalid_argument(fmt::format("--merge = {}: {}", file.string(), what));
}

RunRows read_rows(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) {
    refuse(file, "is no file, must be a runs.jsonl of evaluate --shard");
  }
  try {
    return parse_run_rows(read_file(file));
  } catch (const std::exception& error) {
    refuse(file, std::string(error.what()) + ", must be that of evaluate --shard");
  }
}

/// Number of the campaign's runs.
std::size_t runs_of_heading(const std::filesystem::path& file, const std::string& text) {
  const Json heading = Json::parse(text, nullptr, false);
  if (!heading.is_object() || !heading.contains("policies")) {
    refuse(file, "the first line is not that of a campaign, must be a runs.jsonl of evaluate");
  }
  const Json format = heading.value("format", Json());
  if (format != kRowFormat) {
    refuse(file, fmt::format("rows of format {}, must be {}",
                             format.is_null() ? "none" : format.dump(), kRowFormat));
  }
  const Json runs = heading.value("runs", Json());
  if (!runs.is_number_unsigned() || runs == 0U) refuse(file, "runs, must be a number >= 1");
  return runs.get<std::size_t>();
}

void check_row(const std::filesystem::path& file, std::size_t run, const std::string& row,
               std::size_t runs) {
  if (run >= runs) refuse(file, fmt::format("run = {}, must be in 0 ... {}", run, runs - 1));
  try {
    static_cast<void>(figures_of_row(Json::parse(row)));
  } catch (const std::exception&) {
    refuse(file, fmt::format("the row of run {} is damaged, must be as evaluate wrote it", run));
  }
}

/// The numbers below `runs` without a row, the first ones in full.
std::string missing_text(const std::map<std::size_t, std::string>& rows, std::size_t runs) {
  constexpr std::size_t kShown = 10;
  std::vector<std::size_t> missing;
  for (std::size_t run = 0; run < runs; ++run) {
    if (!rows.contains(run)) missing.push_back(run);
  }
  const std::size_t shown = std::min(missing.size(), kShown);
  return fmt::format("{}{}",
                     fmt::join(missing.begin(), missing.begin() + std::ptrdiff_t(shown), ", "),
                     shown < missing.size() ? ", ..." : "");
}

}  // namespace

RunRows merge_rows(const std::vector<std::filesystem::path>& files) {
  HLC_DEMAND(!files.empty());
  RunRows merged;
  std::map<std::size_t, std::filesystem::path> from;
  std::size_t runs = 0;
  for (const std::filesystem::path& file : files) {
    RunRows read = read_rows(file);
    runs = runs_of_heading(file, read.heading);
    if (merged.heading.empty()) merged.heading = read.heading;
    if (read.heading != merged.heading) {
      refuse(file, fmt::format("another campaign ({}), must be that of {}",
                               differing_keys(read.heading, merged.heading), files[0].string()));
    }
    for (auto& [run, row] : read.rows) {
      check_row(file, run, row, runs);
      const auto [first, is_new] = from.emplace(run, file);
      if (!is_new) {
        refuse(file, fmt::format("run {} is in {}, too, must be in one file", run,
                                 first->second.string()));
      }
      merged.rows.emplace(run, std::move(row));
    }
  }
  if (merged.rows.size() < runs) {
    throw std::invalid_argument(
        fmt::format("--merge: run {} in none of the {} files, must be all runs 0 ... {}; a shard "
                    "that was interrupted goes on with the same command",
                    missing_text(merged.rows, runs), files.size(), runs - 1));
  }
  return merged;
}

}  // namespace hlc::apps
