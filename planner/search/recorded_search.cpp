#include "planner/search/recorded_search.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "planner/search/best_first/best_first_search.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::search {

void check_can_be_recorded(const SearchOptions& options) {
  if (is_admissible(options.cost_to_go)) return;
  throw std::invalid_argument(
      fmt::format("cost_to_go = {}, must be reachable or straight_line for a search tree",
                  to_string(options.cost_to_go)));
}

RecordedSearch record_search(const automaton::Subgraph& subgraph,
                             const automaton::ReachableSets& reachable, SearchOptions options,
                             const HorizonProblem& problem) {
  options.engine = Engine::kBestFirst;
  options.factory = nullptr;
  RecordedSearch recorded;
  BestFirstSearch engine(subgraph, reachable, options);
  engine.record_in(&recorded.tree);
  recorded.result = engine.search(problem, never_stop);
  // Nothing of these searches is recorded: the fast engine finds the same costs sooner.
  if (options.cost_to_go == CostToGo::kReachable) options.engine = Engine::kBranchAndBound;
  const auto& plan = recorded.result.maneuvers;
  recorded.alternatives =
      alternatives_to(plan.empty() ? nullptr : plan.front(), subgraph, reachable, options, problem);
  return recorded;
}

}  // namespace hlc::search
