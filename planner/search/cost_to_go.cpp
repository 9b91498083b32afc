#include "planner/search/cost_to_go.hpp"

#include <algorithm>
#include <cassert>

namespace hlc {

double reachable_cost_to_go(const Point& position_m, std::span<const Point> reference_m,
                            std::span<const double> reach_m) {
  assert(reference_m.size() == reach_m.size());
  double h = 0.0;
  for (std::size_t i = 0; i < reach_m.size(); ++i) {
    const double excess_m = std::max(0.0, (position_m - reference_m[i]).norm() - reach_m[i]);
    h += excess_m * excess_m;
  }
  return h;
}

double cost_to_go_2022(const Point& position_m, std::span<const Point> reference_m,
                       std::span<const double> reach_m) {
  assert(reference_m.size() == reach_m.size());
  double h = 0.0;
  for (std::size_t i = 0; i < reach_m.size(); ++i) {
    const double difference_m = (position_m - reference_m[i]).norm() - reach_m[i];
    h += difference_m * difference_m;
  }
  return h;
}

CostToGoFunction::CostToGoFunction(const Subgraph& subgraph, const ReachableSets& reachable,
                                   const HorizonProblem& problem, CostToGo kind)
    : reference_m_(problem.reference_m), kind_(kind) {
  const std::size_t horizon_steps = problem.horizon_steps();
  const double step_s = subgraph.automaton().step_s;
  assert(horizon_steps <= reachable.max_steps());
  assert(kind != CostToGo::k2022 || problem.reference_speed_mps.size() == horizon_steps);

  // One row more than needed, so that the empty row of depth n has an address.
  reach_m_.resize(subgraph.automaton().trims.size() * (horizon_steps + 1) * horizon_steps + 1);
  for (const TrimId trim : subgraph.starts()) {
    for (std::size_t depth = 0; depth < horizon_steps; ++depth) {
      double marched_m = 0.0;
      for (std::size_t i = 1; i <= horizon_steps - depth; ++i) {
        double& reach_m = reach_m_[row(trim, depth) + i - 1];
        if (kind == CostToGo::kReachable) {
          reach_m = reachable.max_distance_m(trim, i, horizon_steps - depth - i);
        } else {
          marched_m += problem.reference_speed_mps[depth + i - 1] * step_s;
          reach_m = marched_m;
        }
      }
    }
  }
}

}  // namespace hlc
