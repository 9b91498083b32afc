#pragma once

#include <functional>
#include <memory>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::search {

struct SearchTables;

/// An engine asks whether to stop before the first expansion, and after so many more each time.
inline constexpr std::size_t kExpansionsPerStop = 64;

/// For `SearchEngine::search`: only the problem and the engine's own budget end the search.
[[nodiscard]] inline bool never_stop() { return false; }

/// The search of a controller: one call per problem. Not safe for two threads at once.
class SearchEngine {
 public:
  virtual ~SearchEngine() = default;

  /// @param stop    called every kExpansionsPerStop expansions; once it returns true the search
  /// stops as if its budget were used up
  /// @param result  overwritten; its vectors keep their capacity, so that an engine that needs no
  /// other memory allocates nothing from the second call on
  virtual void search(const HorizonProblem& problem, const std::function<bool()>& stop,
                      SearchResult& result) = 0;
  [[nodiscard]] SearchResult search(const HorizonProblem& problem,
                                    const std::function<bool()>& stop) {
    SearchResult result;
    search(problem, stop, result);
    return result;
  }
  [[nodiscard]] SearchResult search(const HorizonProblem& problem) {
    return search(problem, never_stop);
  }
};

/// Empties a result, its vectors keep their capacity: no path, infeasible, nothing counted.
void reset(SearchResult& result);

/// Ends a search that stops early: with its best path so far, whose maneuvers, poses and cost are
/// already in `result`, or without one. A path that costs no more than the bound is optimal.
/// @param lower_bound  of the cost of every open path [m^2]
void stop_early(bool has_path, double lower_bound, SearchResult& result);

/// The engine that `options` name, from `options.factory` if that is given.
/// @param subgraph, reachable  must outlive the engine; `reachable` belongs to `subgraph`
/// @param tables  of make_search_tables for all three; none: the engine makes its own
/// @throws std::invalid_argument if the engine does not support that cost-to-go: kBranchAndBound
/// has the bound kReachable only
[[nodiscard]] std::unique_ptr<SearchEngine> make_search_engine(
    const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
    const SearchOptions& options, std::shared_ptr<const SearchTables> tables = nullptr);

}  // namespace hlc::search
