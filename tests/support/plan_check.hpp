#pragma once

#include <string>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

/// True if the maneuver, driven from `start` in step number `step` (1 ... n), meets no obstacle of
/// that step and no boundary. Polygon by polygon, nothing left out.
[[nodiscard]] bool is_free(const automaton::Maneuver& maneuver, const Pose& start, std::size_t step,
                           const search::HorizonProblem& problem);

/// Checks a plan against the problem, step by step: status, sizes, edges that are switched on and
/// follow each other, poses composed from the displacements (1e-9), no collision, standstill at the
/// end, cost (1e-9). Returns the error; empty if none.
/// @param weights  of the maneuvers' own criteria in the cost
[[nodiscard]] std::string validate(const search::SearchResult& result,
                                   const automaton::Subgraph& subgraph,
                                   const search::HorizonProblem& problem,
                                   const std::vector<search::PlanningWeight>& weights = {});

/// The formula of HorizonProblem, written out again: cost of being at `position_m` after step
/// number `step` (1 ... n) [m^2].
[[nodiscard]] double position_cost_m2(const search::HorizonProblem& problem, std::size_t step,
                                      const Point& position_m);

/// Sum of weight times value of the maneuver's criteria.
[[nodiscard]] double weighted_criteria(const automaton::Maneuver& maneuver,
                                       const std::vector<search::PlanningWeight>& weights);

}  // namespace hlc::test
