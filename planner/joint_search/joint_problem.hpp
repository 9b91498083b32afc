#pragma once

#include <optional>
#include <vector>

#include "planner/geometry/polygon.hpp"
#include "planner/search/horizon_problem.hpp"
#include "planner/search/search_engine.hpp"

namespace hlc::joint_search {

/// One vehicle of a joint problem. The engine is not owned; vehicles may share one.
struct JointVehicle {
  search::HorizonProblem problem;  ///< without the other vehicles of the joint problem
  search::SearchEngine* engine{};  ///< on the vehicle's subgraph, with an admissible cost-to-go
};

/// Find a plan for each vehicle so that no two of them meet in any step, and the sum of their costs
/// (HorizonProblem) is least [m^2]:
///
///     min sum_i cost(plan_i)   so that   A_i(j) and A_k(j) are disjoint, i != k, j = 1 ... n
///
/// with A_i(j) the swept area of vehicle i in step j, safety margin included. Plans end standing,
/// so they stay free of each other after that.
/// @pre at least one vehicle, all with the same horizon n
using JointProblem = std::vector<JointVehicle>;

/// A plan per vehicle; or empty: none.
using JointPlan = std::vector<search::SearchResult>;

/// [m^2]
[[nodiscard]] double cost_of(const JointPlan& plan);

/// The swept areas of a plan, step by step. @pre the plan solves the problem
[[nodiscard]] std::vector<ConvexPolygon> areas_of(const search::SearchResult& plan,
                                                  const search::HorizonProblem& problem);

/// Areas that share less are taken to touch: below it a common point cannot be computed reliably.
inline constexpr double kTouching_m2 = 1e-12;

/// A point inside of both areas, far from their borders if it can be; nothing if they only touch.
[[nodiscard]] std::optional<Point> shared_point_m(const ConvexPolygon& a, const ConvexPolygon& b);

/// Whether two plans share more than that in any step. @pre equally long
[[nodiscard]] bool meet(const std::vector<ConvexPolygon>& areas_a_m,
                        const std::vector<ConvexPolygon>& areas_b_m);

/// Adds areas as obstacles, step by step. @pre one per step of the horizon
void add_obstacles(const std::vector<ConvexPolygon>& areas_m, search::HorizonProblem& problem);

}  // namespace hlc::joint_search
