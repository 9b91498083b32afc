#pragma once

#include <vector>

#include "planner/controller/ended_step.hpp"

/// Which vehicles are the reason why a plan was kept: the only place that decides on it.
namespace hlc::controller {

/// By the reason of the step's fallback:
///
/// * `conflict`: the vehicles whose predictions, received after the search, meet the new plan;
/// * `missing`: the coupled vehicles whose predictions were not received and that could reach the
///   new plan; without a new plan those that may be anywhere or do not receive this vehicle;
/// * `neighbour`: the vehicles that voted against the new plan, or whose vote was not received;
/// * `infeasible`, and a `conflict` of which planning itself found out (a plan that would have
///   drifted into something): the vehicles that stop the optimum without all others, as in point 4
///   of waits_for.hpp. It is one search, after the command was published, if there was no plan.
///   Other motions may be stopped by further vehicles, which are not named. Empty: there is no
///   plan without the others either, or its end askew in the lane made it infeasible.
///
/// A second reason that would have kept the plan alone, such as a prediction not received beside
/// a conflict, is not looked for.
///
/// @return sorted by id; empty for every other reason and status
[[nodiscard]] std::vector<VehicleId> blocked_by(const EndedStep& step);

}  // namespace hlc::controller
