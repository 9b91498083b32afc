#include "planner/search/search_engine.hpp"

#include "planner/search/best_first_search.hpp"

namespace hlc {

std::unique_ptr<SearchEngine> make_search_engine(const Subgraph& subgraph,
                                                 const ReachableSets& reachable,
                                                 const SearchOptions& options) {
  return std::make_unique<BestFirstSearch>(subgraph, reachable, options);
}

}  // namespace hlc
