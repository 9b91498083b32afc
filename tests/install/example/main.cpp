// Plans once around a parked car, with the installed planner: the example of find_package(hlc).
#include <cstdio>
#include <exception>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/scenario/problem_file.hpp"
#include "planner/search/search_engine.hpp"
#include "planner/search/search_options.hpp"

namespace {

hlc::search::SearchResult plan(const hlc::scenario::ProblemFile& file) {
  const hlc::automaton::ReachableSets reachable(*file.subgraph, file.problem.horizon_steps());
  return hlc::search::make_search_engine(*file.subgraph, reachable, file.search)
      ->search(file.problem);
}

}  // namespace

int main() {
  try {
    // The maneuvers of a plan are the subgraph's: the file outlives it.
    const hlc::scenario::ProblemFile file = hlc::scenario::read_problem_file(PROBLEM);
    const hlc::search::SearchResult result = plan(file);
    if (result.status == hlc::search::SearchStatus::kFallback) {
      std::fprintf(stderr, "no plan: %s\n", hlc::search::to_string(result.reason));
      return 1;
    }
    std::printf("%.17g\n", result.cost);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
