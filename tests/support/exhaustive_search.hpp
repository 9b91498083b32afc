#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

struct ExhaustiveResult {
  bool feasible{false};
  double cost{};  ///< [m^2]; only if feasible
  /// Of a path of least cost; empty unless feasible
  std::vector<const automaton::Maneuver*> maneuvers;
  /// Least cost of the paths that begin with a maneuver, for each that a path begins with [m^2]
  std::map<const automaton::Maneuver*, double> cost_by_first;
  std::size_t complete_paths{};  ///< free paths of n steps that end in standstill
};

/// Solves a horizon problem by trying every path: the reference for the search engines. It shares
/// no code with them: no bound, no table, no box, no rule for what can still stop. Its time grows
/// exponentially with the horizon.
/// @param weights  of the maneuvers' own criteria in the cost
[[nodiscard]] ExhaustiveResult exhaustive_search(
    const automaton::Subgraph& subgraph, const search::HorizonProblem& problem,
    const std::vector<search::PlanningWeight>& weights = {});

}  // namespace hlc::test
