#pragma once

#include <memory>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/branch_and_bound/tables.hpp"
#include "planner/search/edge_costs.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::search {

/// Tables that the fast engine computes of a subgraph before its first search: a tenth of a second
/// for a hundred trims. They never change, so planners on the same subgraph share them, and they
/// can be made in advance on another thread.
struct SearchTables {
  /// @param subgraph  owns the maneuvers that the tables name: must outlive them
  SearchTables(const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
               const SearchOptions& options);

  EdgeCosts costs;
  branch_and_bound::TableStore store;
};

/// The tables that the engine of `options` needs; none for an engine without any.
/// @pre `reachable` belongs to `subgraph` and has at most 80 steps
/// @throws std::invalid_argument as EdgeCosts
[[nodiscard]] std::shared_ptr<const SearchTables> make_search_tables(
    const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
    const SearchOptions& options);

}  // namespace hlc::search
