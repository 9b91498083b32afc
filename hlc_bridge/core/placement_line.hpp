#pragma once

#include <string>

#include "planner/controller/controller.hpp"

namespace hlc {

/// Where the vehicle stands, for the operator, in one line: its route and place there, or that it
/// fits none, how far off it is and what is allowed.
/// @pre the controller has a placement
[[nodiscard]] std::string placement_line(const Controller& controller);

/// That a vehicle cannot get onto its route from where it stands (joining.hpp).
[[nodiscard]] std::string stuck_line(const Controller& controller);

}  // namespace hlc
