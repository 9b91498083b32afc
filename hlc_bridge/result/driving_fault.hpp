#pragma once

#include <string>

#include "hlc_bridge/result/run_summary.hpp"

/// Whether a run was driven well: the only criterion, for one run and in a campaign.
namespace hlc::result {

/// Why a run's driving was dangerous, in one line: vehicles touched, or a vehicle left the areas
/// that it had announced (VehicleSummary::steps_outside_announced_area). Empty if it was not. A
/// campaign excludes such a run.
[[nodiscard]] std::string danger_of(const RunSummary& summary);

/// Why a run was driven badly: a danger, or a vehicle was farther from its plan than the safety
/// margin and than an undisturbed one of its lab (RunDescription::tracking_error_max_m), even if
/// within its announced areas: then it was no danger, but did not drive its plan (subgraph A
/// demands more than the car can do, which its controller predicts).
[[nodiscard]] std::string driving_fault(const RunSummary& summary);

}  // namespace hlc::result
