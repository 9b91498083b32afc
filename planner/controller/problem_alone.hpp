#pragma once

#include "planner/automaton/automaton.hpp"
#include "planner/controller/controller_options.hpp"
#include "planner/controller/route_tracker.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc {

/// The problem of a vehicle without all others: from where its traffic says it will be, along its
/// route from where it is on that, within the corridor as far as it may get.
/// @param reach_m  how far the vehicle can get in a horizon
/// @pre the tracker has selected a route
[[nodiscard]] HorizonProblem problem_alone(const Traffic& own, const RouteTracker& tracker,
                                           const Corridor& corridor, double reach_m,
                                           const UniversalAutomaton& automaton,
                                           const ControllerOptions& options);

/// What a problem becomes a step later, if everybody keeps to what was known: from where the
/// vehicle will be, every step's reference and obstacles a step earlier, the last ones guessed.
/// Without its incumbent, whose maneuvers may be gone.
[[nodiscard]] HorizonProblem one_step_later(HorizonProblem problem, const Traffic& own);

}  // namespace hlc
