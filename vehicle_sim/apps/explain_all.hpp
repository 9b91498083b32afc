#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hlc_bridge/record/run_folder.hpp"
#include "vehicle_sim/apps/explanation.hpp"
#include "vehicle_sim/apps/step_answers.hpp"

namespace hlc::apps {

/// Vehicles with a row in the step, without this one.
/// @param step  from 0
[[nodiscard]] std::vector<VehicleId> others_in(std::span<const result::StepRecord> rows,
                                               std::uint64_t step, VehicleId own);

/// What is known of a step without another drive.
/// @param outcome  of that step; its vehicle's
[[nodiscard]] ExplainedStep explained_step(const record::RunFolder& run, std::uint64_t step,
                                           StepOutcome outcome, StepAnswers answers);

/// Drives the run once more and explains all of result::steps_to_explain, with progress on a
/// terminal; writes explanations.csv, then run.html with them.
/// @return number of explanations
/// @throws std::invalid_argument as options_of_run and check_same_until, nothing is written then;
/// std::runtime_error naming the file that cannot be written
std::size_t explain_all(record::RunFolder run);

}  // namespace hlc::apps
