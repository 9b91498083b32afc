#pragma once

#include <optional>

#include "planner/controller/route_tracker.hpp"
#include "planner/coordination/plan.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::controller {

/// A plan that ends this much before its reference does is held up.
inline constexpr double kHeldUp_m = 0.1;

/// Arc length of the place on the path where the plan ends, counted on from the tracker's, if the
/// plan is held up: it ends at least kHeldUp_m before the last reference point.
///
/// A reference point lies where a free vehicle would be, and across the path is what is across it
/// there. For a vehicle that is held up before a bend this is along its own lane, so it would leave
/// the lane to lower the cost, and block the next one. Its reference has to end where it can get to
/// (`with_reference_of` a problem that is posed up to there); a second search then finds a plan
/// that gets about as far and stays in the lane. If that plan stands and the first one moves, the
/// first one is kept: a vehicle in a narrow gap may get out of it a little in each step.
/// @param next     the plan is known from t(next) on
/// @param tracker  has selected a route
/// @param reach_m  as for RouteTracker::project
/// @pre `problem` has a reference
[[nodiscard]] std::optional<double> held_up_at_m(const coordination::Plan& plan, StepIndex next,
                                                 const search::HorizonProblem& problem,
                                                 const RouteTracker& tracker, double reach_m);

/// The problem with the reference points, speeds and contouring directions of the other one.
/// @pre both have the same horizon
[[nodiscard]] search::HorizonProblem with_reference_of(search::HorizonProblem problem,
                                                       const search::HorizonProblem& other);

}  // namespace hlc::controller
