#include "planner/search/search_engine.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner/search/best_first/best_first_search.hpp"
#include "planner/search/branch_and_bound/branch_and_bound.hpp"

namespace hlc::search {

void reset(SearchResult& result) {
  result.status = SearchStatus::kFallback;
  result.reason = NoPath::kInfeasible;
  result.cost = 0.0;
  result.lower_bound = 0.0;
  result.maneuvers.clear();
  result.poses.clear();
  result.generated = 0;
  result.expanded = 0;
}

void stop_early(bool has_path, double lower_bound, SearchResult& result) {
  if (!has_path) {
    result.status = SearchStatus::kFallback;
    result.reason = NoPath::kBudget;
    result.lower_bound = lower_bound;
    return;
  }
  result.status = lower_bound >= result.cost ? SearchStatus::kOptimal : SearchStatus::kBudget;
  result.reason = NoPath::kNone;
  result.lower_bound = std::min(lower_bound, result.cost);
}

std::unique_ptr<SearchEngine> make_search_engine(const automaton::Subgraph& subgraph,
                                                 const automaton::ReachableSets& reachable,
                                                 const SearchOptions& options,
                                                 std::shared_ptr<const SearchTables> tables) {
  if (options.factory != nullptr) {
    return options.factory(subgraph, reachable, options, std::move(tables));
  }
  if (options.engine == Engine::kBestFirst) {
    return std::make_unique<BestFirstSearch>(subgraph, reachable, options);
  }
  return std::make_unique<BranchAndBound>(subgraph, reachable, options,
                                          BranchAndBound::Instructions::kAvx512, std::move(tables));
}

}  // namespace hlc::search
