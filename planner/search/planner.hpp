#pragma once

#include <functional>
#include <memory>

#include "planner/search/horizon_problem.hpp"
#include "planner/search/search_engine.hpp"

namespace hlc {

/// What the controller plans with: one call per plan. The implementation plans through an
/// `ompl::base::Planner`; no OMPL name shows here. Not safe for two threads at once.
class HorizonPlanner {
 public:
  virtual ~HorizonPlanner() = default;
  /// @param stop  as for SearchEngine::search
  [[nodiscard]] virtual SearchResult plan(const HorizonProblem& problem,
                                          const std::function<bool()>& stop) = 0;
  [[nodiscard]] SearchResult plan(const HorizonProblem& problem) {
    return plan(problem, never_stop);
  }
};

/// @param subgraph, reachable  must outlive the planner; `reachable` for at least the horizon
/// @param tables  of make_search_tables for all three; none: it makes what it needs
/// @throws std::invalid_argument as make_search_engine
[[nodiscard]] std::unique_ptr<HorizonPlanner> make_horizon_planner(
    const Subgraph& subgraph, const ReachableSets& reachable, const SearchOptions& options,
    std::shared_ptr<const SearchTables> tables = nullptr);

}  // namespace hlc
