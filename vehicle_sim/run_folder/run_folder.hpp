#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::run_folder {

/// Writes the files that the processes of this run would have written (hlc_bridge/record):
/// run.json, reports.csv, certificates.csv, vehicle_<id>.csv and configuration/. `summarize` and
/// `export_commonroad` read it. An existing folder of an interrupted run is overwritten.
/// @throws std::runtime_error naming the file that cannot be written
/// @param noise_seed  ExperimentOptions::noise_seed
void write_run_folder(const std::filesystem::path& folder, const scenario::Scenario& scenario,
                      std::optional<std::uint64_t> noise_seed,
                      const closed_loop::Experiment& experiment);

/// Its configuration/ only, with copies of the files as they are now.
/// @throws std::runtime_error naming the file that cannot be read or written
void write_configuration(const std::filesystem::path& folder, const scenario::Scenario& scenario,
                         std::optional<std::uint64_t> noise_seed);

/// Its records only: run.json, reports.csv, certificates.csv and vehicle_<id>.csv, in a folder that
/// exists.
/// @throws std::runtime_error naming the file that cannot be written
void write_records(const std::filesystem::path& folder, const closed_loop::Experiment& experiment);

/// True if such a folder exists and is complete.
[[nodiscard]] bool is_whole_run_folder(const std::filesystem::path& folder);

}  // namespace hlc::run_folder
