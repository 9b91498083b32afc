#pragma once

#include <string>

#include "hlc_bridge/result/run_summary.hpp"

/// Whether a run was well driven. Nothing else decides that, neither for one run nor in a campaign.
namespace hlc {

/// Why a run's driving was dangerous, in one line: vehicles touched, or a vehicle was outside the
/// areas that it had told the others (VehicleSummary::steps_outside_announced_area). Empty if it
/// was not. A campaign leaves such a run out.
[[nodiscard]] std::string danger_of(const RunSummary& summary);

/// Why a run was driven badly: a danger, or a vehicle was farther from its plan than the safety
/// margin, be it within the areas that it had told: then it endangered nobody, but it did not drive
/// what was planned (subgraph A asks for more than the car gives, and its controller knows).
[[nodiscard]] std::string driving_fault(const RunSummary& summary);

}  // namespace hlc
