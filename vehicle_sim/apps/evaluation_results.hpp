#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/apps/result_folder.hpp"
#include "vehicle_sim/apps/run_log.hpp"
#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc::apps {

/// Of the rows of a campaign (EvaluationFiles): a change of their meaning counts it up. The heading
/// of the rows has it as "format", and the number of the campaign's runs as "runs".
inline constexpr std::size_t kRowFormat = 1;

/// The names of the files that write_results writes.
[[nodiscard]] const std::vector<std::string>& result_files();

/// The figures of a row, from the row alone.
/// @throws nlohmann::json::exception if it is no row of a campaign
[[nodiscard]] campaign::RunFigures figures_of_row(const nlohmann::ordered_json& row);

/// The figures of all rows, by run. @pre EvaluationFiles or merge_rows checked them
[[nodiscard]] std::vector<campaign::RunFigures> figures_of_rows(const RunLog& log);

/// Writes campaign.json, runs.csv and cars.csv (row_tables.hpp) beside the rows: of equal rows the
/// same.
void write_results(const RunLog& log, const EvaluationOrigin& origin);

}  // namespace hlc::apps
