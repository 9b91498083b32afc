#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/collision.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::search {

/// The best plan that begins with a certain maneuver.
struct Alternative {
  const automaton::Maneuver* first{};
  std::optional<Obstruction> obstruction;  ///< what `first` itself meets: then there is no plan
  /// Of the whole plan of n steps; a plan found costs least of those that begin with `first`
  /// (kOptimal), or is the best one within the budget. Counts of the search behind `first`.
  SearchResult best;
};

/// What else a plan could have begun with: for each first maneuver except one, the best plan.
///
/// Every one is found by a search of its own, of the n - 1 steps behind it, so this takes about as
/// many searches as the start has edges, each with the options' budget. Works with every engine.
/// @param reachable  belongs to `subgraph`
/// @param except     the first maneuver of the plan in question; nullptr: none is left out
/// @param tables     as for make_search_engine
/// @pre as SearchEngine::search, n >= 1, the cost-to-go is admissible
/// @throws std::invalid_argument as make_search_engine
[[nodiscard]] std::vector<Alternative> alternatives_to(
    const automaton::Maneuver* except, const automaton::Subgraph& subgraph,
    const automaton::ReachableSets& reachable, const SearchOptions& options,
    const HorizonProblem& problem, std::shared_ptr<const SearchTables> tables = {});

/// The runner-up: the plan of least cost among these, so the best plan with another first maneuver.
/// If costs are equal, the first.
/// @return nullptr if there is none
[[nodiscard]] const Alternative* runner_up(const std::vector<Alternative>& alternatives);

}  // namespace hlc::search
