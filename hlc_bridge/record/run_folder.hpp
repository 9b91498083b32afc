#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::record {

/// What a run folder holds.
struct RunFolder {
  std::filesystem::path folder;
  RunChoices choices;  ///< with which it was driven
  scenario::Scenario scenario;
  result::RunDescription description;
  result::RunFacts facts;
  result::Drives drives;
  std::vector<result::StepRecord> rows;  ///< of step_records()
  std::vector<std::string> incomplete;   ///< of incomplete_files()
};

/// Reads the raw records of a run and its scenario. A run that lab control did not end begins with
/// the first step that any vehicle planned. Records that end early are no error.
/// @param given  as in choices_of_run
/// @throws std::runtime_error, std::invalid_argument with one line that names the file and what is
/// wrong: a folder without run.json or reports.csv, invalid records, choices_of_run, read_scenario,
/// check_run
[[nodiscard]] RunFolder read_run_folder(const std::filesystem::path& folder,
                                        const RunChoices& given);

/// The same of a run whose configuration/flags.yaml must be there.
[[nodiscard]] RunFolder read_run_folder(const std::filesystem::path& folder);

/// How many steps are recorded from step 0 on; a last one whose rows are not all there, as when the
/// run was killed, does not count.
[[nodiscard]] std::uint64_t recorded_steps(const RunFolder& run);

}  // namespace hlc::record
