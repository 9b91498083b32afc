#pragma once

#include <string>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

/// True if the maneuver, driven from `start` in step number `step` (1 ... n), meets no obstacle of
/// that step and no boundary. Polygon by polygon, nothing left out.
[[nodiscard]] bool is_free(const Maneuver& maneuver, const Pose& start, std::size_t step,
                           const HorizonProblem& problem);

/// Checks a plan against the problem, step by step: status, sizes, edges that are switched on and
/// follow each other, poses composed from the displacements (1e-9), no collision, standstill at the
/// end, cost (1e-9). Says what is wrong; empty if nothing is.
[[nodiscard]] std::string fault_of(const SearchResult& result, const Subgraph& subgraph,
                                   const HorizonProblem& problem);

}  // namespace hlc::test
