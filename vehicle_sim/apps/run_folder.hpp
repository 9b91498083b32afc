#pragma once

#include <filesystem>

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc {

/// Writes what the processes of this run would have left behind (hlc_bridge/record): run.json,
/// reports.csv, vehicle_<id>.csv and configuration/. `summarize` and `export_commonroad` read it.
/// A folder that is there from a run that was interrupted is written anew.
/// @throws std::runtime_error naming the file that cannot be written
void write_run_folder(const std::filesystem::path& folder, const Scenario& scenario,
                      const Experiment& experiment);

/// True if such a folder is there as a whole.
[[nodiscard]] bool is_whole_run_folder(const std::filesystem::path& folder);

}  // namespace hlc
