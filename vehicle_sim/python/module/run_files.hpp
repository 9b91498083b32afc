#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::python {

/// Makes the folder, before anything is driven for it.
/// @throws std::invalid_argument naming it if it cannot be made, or has something in it
void make_run_folder(const std::filesystem::path& folder);

/// What was driven, and with what.
struct DrivenRun {
  const scenario::Scenario& scenario;
  const std::string& changed_text;  ///< of its file; empty: the file's own
  std::optional<std::uint64_t> noise_seed;
  const std::vector<record::KeptFork>& forks;
  const closed_loop::Experiment& experiment;
  const std::vector<result::StepRecord>& rows;
};

/// Writes the files of run_lab.sh without logs and messages (hlc_bridge/record): the records, the
/// configuration with which the programs drive it again, result and page.
/// @throws std::runtime_error naming the file that cannot be written
void write_run(const std::filesystem::path& folder, const DrivenRun& run);

}  // namespace hlc::python
