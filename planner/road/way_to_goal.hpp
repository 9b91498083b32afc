#pragma once

#include <set>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "planner/road/goal.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/road/planning_problem.hpp"

namespace hlc::road {

/// How a planning problem is driven: an open route, the vehicle's place on it, and a region in
/// which it ends.
struct WayToGoal {
  std::vector<LaneletId> lanelets;
  double start_s_m{};         ///< arc length on the route's path
  double start_left_m{};      ///< of the path: in a lane beside it, which the corridor contains
  double start_turned_rad{};  ///< heading minus the path's
  ConvexPolygon goal_m;
  Stretch stretch_in_goal;   ///< of the path
  std::size_t goal_state{};  ///< index in the planning problem
};

/// Most corners of the region of a way.
inline constexpr std::size_t kMostGoalCorners = 32;

/// The way to the first goal state of the problem to which there is one.
///
/// It begins in the lanelet that the start lies in, the one that its heading fits best, or in a
/// neighbour of the same direction, to which the vehicle then changes: the fewest lanes away. From
/// there it is the shortest sequence of successors, all in `for_cars`, whose path enters one of the
/// regions after the start, and first so for at least the vehicle's length: a vehicle whose
/// footprint covers the middle of that stretch is in the region. Of a lanelet the region is a
/// convex part (lanelet_pieces.hpp).
///
/// The vehicle stands when it has arrived (goal.hpp), with its heading as the path's up to
/// kFitsTurned_rad. Hence a goal state is honoured only if its speeds include 0 and its headings
/// all those of the path in the region with that error.
/// @throws std::runtime_error one line, "planning problem 7: fault and bound": a start beside all
/// lanelets, against their direction or not on the map with its whole footprint; no goal state that
/// has a way and can be honoured (the fault is that of the first)
[[nodiscard]] WayToGoal way_to_goal(const LaneletMap& map, const std::set<LaneletId>& for_cars,
                                    const PlanningProblem& problem, const Footprint& footprint);

}  // namespace hlc::road
