#pragma once

#include "planner/scenario/scenario.hpp"

namespace hlc::scenario {

/// For a scenario with `right_of_way`: driving lines and numbers of its routes and of its vehicles'
/// own, and the conflict map of all of them. To be called again when the vehicles were drawn again.
/// @throws std::invalid_argument naming a route on which a car could wait nowhere, or one that an
/// obstacle lies on
void relate_routes(Scenario& scenario);

}  // namespace hlc::scenario
