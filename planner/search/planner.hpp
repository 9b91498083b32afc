#pragma once

#include <memory>

#include "planner/search/horizon_problem.hpp"

namespace hlc {

/// What the controller plans with: one call per plan. The implementation plans through an
/// `ompl::base::Planner`; no OMPL name shows here. Not safe for two threads at once.
class HorizonPlanner {
 public:
  virtual ~HorizonPlanner() = default;
  [[nodiscard]] virtual SearchResult plan(const HorizonProblem& problem) = 0;
};

/// @param subgraph, reachable  must outlive the planner; `reachable` for at least the horizon
[[nodiscard]] std::unique_ptr<HorizonPlanner> make_best_first_planner(
    const Subgraph& subgraph, const ReachableSets& reachable, SearchOptions options);

}  // namespace hlc
