#pragma once

#include <cstddef>
#include <vector>

#include "planner/controller/obstacles.hpp"
#include "planner/search/horizon_problem.hpp"

/// Gives priorities a meaning under the commit rule `strict` (coordination/commit.hpp).
///
/// `strict` alone lets vehicles stand in front of each other forever, each with an optimal plan: a
/// vehicle must keep clear of the plans in force of those that plan after it, too, so that they
/// stop it, and then plan around a vehicle that stands. With `makes_room`, in step k:
///
///   * Vehicle i also solves its problem as if those that plan after it vanished at t(k+2), and
///     kept clear of the desired plans of those that plan before it. If this plan is better than
///     new_i it is the *desired plan* d_i, and published with the prediction.
///   * A vehicle j that plans after i keeps clear of d_i if it can: of all of it; else of where it
///     leads, that is in the last step, which lasts forever since plans end standing; else it plans
///     as without d_i.
///
/// In step k+1 old_j leaves room for what i desired, so that i finds it, and prefers it.
///
/// Safety does not depend on it: desired plans only add obstacles to the search, and what `strict`
/// requires is checked as before. A desired plan that is lost, late or senseless costs nothing but
/// the time to search. Nor does recursive feasibility: the last problem that j searches is that
/// without desired plans, of which the rest of its plan in force is a solution.
///
/// Known as desired trajectories, beside planned ones, from the maneuver coordination of automated
/// road vehicles: B. Lehmann, H.-J. Guenther, L. Wolf, "A Generic Approach towards Maneuver
/// Coordination for Automated Vehicles", ITSC 2018.
namespace hlc::controller {

/// What the desired plan keeps clear of (a CoupledObstacleRule): of a predecessor its new plan, or
/// the one in force if it has none, and its desired one; of others their plan in force until
/// t(k+2).
void desired_plans_of_predecessors(const CoupledVehicle& other, StepIndex step,
                                   std::vector<ConvexPolygon>& areas_m);

/// A search for a desired plan, or for a plan that makes room, may use one expansion in eight of
/// those that a search may use: three of them in a step, and with right of way once more for a plan
/// that is held up. The vertices of the desired plan's search are not counted in reports.
inline constexpr std::size_t kMakingRoomShare = 8;

/// The problem with one more obstacle for each desired plan, during its steps from `from` on (0:
/// the first one, from t(next) on).
[[nodiscard]] search::HorizonProblem making_room(
    search::HorizonProblem problem, const std::vector<const coordination::OccupiedAreas*>& desired,
    StepIndex next, std::size_t from);

}  // namespace hlc::controller
