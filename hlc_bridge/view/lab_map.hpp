#pragma once

#include <vector>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/controller/controller.hpp"

namespace hlc::view {

/// Drawings of a controller on the lab control centre's map for the operator:
///
/// * the plan in force from t(k) to its end, a green line (red after a step that fell back),
/// * the reference points of the step's search, a grey line, if there was one,
/// * a text beside the vehicle: its id and the step's status with the reason.
///
/// Coordinates are the lab's [m]. Every vehicle has its own ids, so that a step's drawings replace
/// those of the step before.
/// @param report        of the controller's last step
/// @param time_to_live  of all drawings: longer than a period, otherwise they flicker
[[nodiscard]] std::vector<Visualization> lab_map(const controller::Controller& controller,
                                                 const coordination::Report& report,
                                                 Nanoseconds time_to_live);

}  // namespace hlc::view
