#pragma once

#include <string>

#include "hlc_bridge/core/run_summary.hpp"

namespace hlc {

/// Why a run was driven badly, in one line: vehicles touched, or a vehicle was outside the areas
/// that it had told the others (VehicleSummary::astray_steps). Empty if it was well driven. Nothing
/// else decides that, neither for one run nor in a campaign.
///
/// A vehicle that is farther from its plan than the safety margin, but within the areas that it had
/// told, endangers nobody: subgraph A asks for more than the car gives, and its controller knows.
[[nodiscard]] std::string fault_of(const RunSummary& summary);

}  // namespace hlc
