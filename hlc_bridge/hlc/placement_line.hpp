#pragma once

#include <string>

#include "planner/controller/controller.hpp"

namespace hlc {

/// Where the vehicle stands, for the operator, in one line: its route and place there, or that it
/// fits none, how far off it is and what is allowed.
/// @pre the controller has a placement
[[nodiscard]] std::string placement_line(const Controller& controller);

/// Why a vehicle stays with its former plan, where that may last: kOffRoute, it cannot get onto its
/// route from where it stands (lane_entry.hpp), or kBudget.
[[nodiscard]] std::string stuck_line(const Controller& controller, FallbackReason reason);

}  // namespace hlc
