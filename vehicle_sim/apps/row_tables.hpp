#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"

/// The rows of a campaign or a sweep as comma-separated values, for vehicle_sim/report and any
/// other program. Numbers read back to the same bits, an absent value is an empty field.
namespace hlc::apps {

/// A run with its figures.
struct RunRow {
  std::size_t run{};
  std::vector<std::string> settings;  ///< of a sweep, as many as `setting_names`
  campaign::RunFigures figures;
  bool was_driven{};  ///< otherwise only its identity and its failure are known
};

/// runs.csv, a row per run: `run`, the settings, scenario, profile, subgraph, policy, start,
/// failure (empty: it counts), the keys of figures_record.hpp, and `share.NAME` for each subgraph
/// that any run planned on.
/// @param has_times  with the columns of planning and wall times
[[nodiscard]] std::string runs_csv(const std::vector<std::string>& setting_names,
                                   const std::vector<RunRow>& rows, bool has_times);

/// cars.csv, a row per run and vehicle: the run's identity, `vehicle` (its id), `name`, and the
/// figures of the vehicle in summary.json.
/// @param records  of runs.jsonl (EvaluationFiles); of a run that was not driven there is no row
[[nodiscard]] std::string cars_csv(const std::vector<nlohmann::ordered_json>& records);

}  // namespace hlc::apps
