#pragma once

#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/alternatives.hpp"
#include "planner/search/best_first/search_tree.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::search {

/// A decision: the plan found, every vertex that was looked at, and the best plans with another
/// first maneuver.
struct RecordedSearch {
  SearchResult result;
  SearchTree tree;
  /// To the result's first maneuver; of all first maneuvers if there is no plan.
  std::vector<Alternative> alternatives;
};

/// @throws std::invalid_argument with one line if the cost-to-go is not admissible
void check_can_be_recorded(const SearchOptions& options);

/// Searches with the best-first engine, whatever engine the options name; for the alternatives with
/// the fast engine if it has the cost-to-go.
/// @param reachable  belongs to `subgraph`
/// @pre as BestFirstSearch::search, n >= 1, the cost-to-go is admissible
[[nodiscard]] RecordedSearch record_search(const automaton::Subgraph& subgraph,
                                           const automaton::ReachableSets& reachable,
                                           SearchOptions options, const HorizonProblem& problem);

}  // namespace hlc::search
