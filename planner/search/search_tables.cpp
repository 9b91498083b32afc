#include "planner/search/search_tables.hpp"

#include <algorithm>
#include <cstddef>

namespace hlc::search {

SearchTables::SearchTables(const automaton::Subgraph& subgraph,
                           const automaton::ReachableSets& reachable, const SearchOptions& options)
    : costs(subgraph, options.criterion_weights, std::max<std::size_t>(reachable.max_steps(), 1)),
      store(subgraph, reachable, costs) {}

std::shared_ptr<const SearchTables> make_search_tables(const automaton::Subgraph& subgraph,
                                                       const automaton::ReachableSets& reachable,
                                                       const SearchOptions& options) {
  if (options.engine != Engine::kBranchAndBound) return nullptr;
  return std::make_shared<const SearchTables>(subgraph, reachable, options);
}

}  // namespace hlc::search
