#pragma once

#include <optional>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

/// Least sum of the costs of one plan per vehicle of which no two meet in any step [m^2]; nothing
/// if there are none. Tries every combination, so it is for two or three vehicles and few steps; it
/// shares no code with the joint search.
[[nodiscard]] std::optional<double> exhaustive_joint_search(
    const automaton::Subgraph& subgraph, const std::vector<search::HorizonProblem>& problems);

}  // namespace hlc::test
