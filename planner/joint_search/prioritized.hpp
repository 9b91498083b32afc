#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "planner/joint_search/joint_problem.hpp"

namespace hlc::joint_search {

/// Order of planning: every index of the joint problem once.
using Order = std::vector<std::size_t>;

/// 0, 1, 2, ...
[[nodiscard]] Order constant_order(std::size_t num_vehicles);

/// Future collision assessment: vehicles whose plans meet more other vehicles' plans are first, of
/// equal ones the smaller index. @param alone  each vehicle's optimum without the others
[[nodiscard]] Order most_collisions_first(const JointProblem& problem, const JointPlan& alone);

/// Each vehicle's optimum without the others; empty if one of them has no plan.
[[nodiscard]] JointPlan plan_alone(const JointProblem& problem);

/// Plans one after the other, each around the plans of those before it. Empty if one finds nothing.
[[nodiscard]] JointPlan plan_in_order(const JointProblem& problem,
                                      std::span<const std::size_t> order);

/// Of all m! orders that of the cheapest plans, of equal ones the first in lexicographic order.
/// Empty if none leads to a plan. @pre at most 8 vehicles
[[nodiscard]] JointPlan plan_in_best_order(const JointProblem& problem);

}  // namespace hlc::joint_search
