#pragma once

#include <span>

#include "planner/automaton/subgraph.hpp"
#include "planner/joint_search/conflict_based_search.hpp"
#include "planner/search/horizon_problem.hpp"
#include "planner/search/search_engine.hpp"

namespace hlc::joint_search {

/// The solution of a joint problem, and what planning one after the other would give.
struct JointSolution {
  JointPlan alone;           ///< without each other; empty: one has no plan
  JointPlan constant_order;  ///< the first vehicle first; may be empty
  JointPlan best_order;      ///< of all orders; may be empty
  JointSearchResult joint;
};

/// Of vehicles on one subgraph, with one engine for all.
/// @param problems  of each vehicle, without the others; 1 to 8, all with the same horizon
/// @throws std::invalid_argument naming the cost-to-go of `search` unless it is admissible
[[nodiscard]] JointSolution solve(const automaton::Subgraph& subgraph,
                                  const search::SearchOptions& search,
                                  std::span<const search::HorizonProblem> problems,
                                  const JointSearchOptions& options);

}  // namespace hlc::joint_search
