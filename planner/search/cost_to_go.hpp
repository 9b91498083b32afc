#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc {

/// Lower bound on the cost of m = reach_m.size() further steps from `position_m`:
///
///     h = sum_{i=1}^{m} max(0, || p - r_i || - d_i)^2   [m^2]
///
/// After i steps the vehicle is at most d_i away from p, so the triangle inequality gives
/// || p_i - r_i || >= || p - r_i || - d_i. Each term bounds its own term of the cost; hence h never
/// exceeds the true cost-to-go, with or without obstacles. It may as soon as one d_i is smaller
/// than what can be reached.
///
/// @param reference_m  r_1 ... r_m of the remaining steps, same size as `reach_m`
/// @param reach_m      d_1 ... d_m, the largest distance from p after exactly i steps
/// @return 0 without remaining steps
[[nodiscard]] double reachable_cost_to_go(const Point& position_m,
                                          std::span<const Point> reference_m,
                                          std::span<const double> reach_m);

/// The authors' bound of 2022, without the floor at 0:
///
///     h = sum_{i=1}^{m} (|| p - r_i || - d_i)^2
///
/// with d_i = sum of reference speed times step length. Inadmissible: a reference point that is
/// nearer than d_i costs as much as one that is farther. For the comparison with the paper only.
[[nodiscard]] double cost_to_go_2022(const Point& position_m, std::span<const Point> reference_m,
                                     std::span<const double> reach_m);

/// The cost-to-go of one horizon problem, for every vertex of its search tree.
///
/// `kReachable` takes d_i = ReachableSets::max_distance_m(trim, i, n - depth - i): how far exactly
/// i steps from the vertex' trim can lead on paths that can still end in standstill at the horizon.
/// It is admissible if `reachable` was computed for the very subgraph that is searched.
///
/// `k2022` takes d_i from the reference speeds of the steps after `depth`: their sum over the next
/// i steps times the step length.
class CostToGoFunction {
 public:
  /// @param problem  must outlive this object
  /// @pre problem.horizon_steps() <= reachable.max_steps()
  /// @pre with k2022: one reference speed per step
  CostToGoFunction(const Subgraph& subgraph, const ReachableSets& reachable,
                   const HorizonProblem& problem, CostToGo kind);

  /// @param depth  steps already done, 0 ... n
  /// @pre `trim` is one of the subgraph's `starts` and can stand within the n - depth steps left
  [[nodiscard]] double operator()(TrimId trim, std::size_t depth, const Point& position_m) const {
    const std::size_t steps_left = reference_m_.size() - depth;
    const std::span<const double> reach_m{&reach_m_[row(trim, depth)], steps_left};
    const std::span<const Point> reference_m = reference_m_.subspan(depth);
    return kind_ == CostToGo::kReachable ? reachable_cost_to_go(position_m, reference_m, reach_m)
                                         : cost_to_go_2022(position_m, reference_m, reach_m);
  }

 private:
  [[nodiscard]] std::size_t row(TrimId trim, std::size_t depth) const {
    return (trim.index * (reference_m_.size() + 1) + depth) * reference_m_.size();
  }

  std::span<const Point> reference_m_;
  CostToGo kind_;
  std::vector<double> reach_m_;  ///< one row of n per trim and depth, n - depth of it in use
};

}  // namespace hlc
