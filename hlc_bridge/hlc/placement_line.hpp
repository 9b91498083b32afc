#pragma once

#include <string>

#include "planner/controller/controller.hpp"

namespace hlc::high_level_controller {

/// The vehicle's placement in one line for the operator: its route and place there, or that it fits
/// none, with the errors and their limits.
/// @pre the controller has a placement
[[nodiscard]] std::string placement_line(const controller::Controller& controller);

/// Why a vehicle keeps its former plan, where that may last: kOffRoute, it cannot get onto its
/// route from where it stands (lane_entry.hpp), or kBudget.
[[nodiscard]] std::string stuck_line(const controller::Controller& controller,
                                     coordination::FallbackReason reason);

/// Where a vehicle is that is elsewhere (rule 6 of plan_in_force.hpp), and what the operator is to
/// do. @pre it is
[[nodiscard]] std::string elsewhere_line(const controller::Controller& controller);

}  // namespace hlc::high_level_controller
