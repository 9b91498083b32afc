#pragma once

#include "vehicle_sim/campaign/campaign.hpp"

namespace hlc::campaign {

/// Drives the scenario with vehicles that are always where their plans are, as in the paper's
/// simulation: no vehicle model, no follower, no delay. A vehicle's yaw is that of the identified
/// vehicle on the planned path (yaw_minus_heading_rad). No times are measured.
[[nodiscard]] DrivenRun drive_exactly(scenario::Scenario scenario);

}  // namespace hlc::campaign
