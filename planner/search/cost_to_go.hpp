#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/edge_costs.hpp"
#include "planner/search/frame.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::search {

/// Lower bound on the distance from `q_m` to every position that `reach` contains [m]:
///
///     max(0, || q || - d, max_i (n_i q - s_i))
///
/// For p in the set, || p - q || >= || q || - || p || >= || q || - d, and because n_i is a unit
/// vector, || p - q || >= n_i (q - p) >= n_i q - s_i.
///
/// @param q_m  in the frame of `reach`
/// @return +infinity for the empty set
[[nodiscard]] double distance_beyond_m(const Point& q_m, const automaton::Reach& reach);

/// Lower bound on the cost of m = reach_m.size() further steps from `position_m`:
///
///     h = sum_{i=1}^{m} max(0, || p - r_i || - d_i)^2   [m^2]
///
/// After i steps the vehicle is at most d_i away from p, so the triangle inequality gives || p_i -
/// r_i || >= || p - r_i || - d_i. Each term bounds its own term of the cost. It may exceed the cost
/// as soon as one d_i is smaller than the vehicle's reach.
///
/// @param reference_m  r_1 ... r_m of the remaining steps, same size as `reach_m`
/// @param reach_m      d_1 ... d_m, the largest distance from p after exactly i steps
/// @return 0 without remaining steps
[[nodiscard]] double straight_line_cost_to_go(const Point& position_m,
                                              std::span<const Point> reference_m,
                                              std::span<const double> reach_m);

/// The authors' bound of 2022, without the floor at 0:
///
///     h = sum_{i=1}^{m} (|| p - r_i || - d_i)^2
///
/// with d_i = sum of reference speed times step length. Inadmissible: a reference point that is
/// nearer than d_i costs as much as one that is farther. For the comparison with the paper only.
[[nodiscard]] double reference_speed_cost_to_go(const Point& position_m,
                                                std::span<const Point> reference_m,
                                                std::span<const double> reach_m);

/// The cost-to-go of one horizon problem of n steps, for every vertex of its search tree.
///
/// `kReachable`, for a vertex at position p with heading psi after `depth` steps:
///
///     h = sum_{i=1}^{n - depth} e_i^2,   e_i = distance_beyond_m(q_i, S_i),
///     q_i = R(-psi) (r_{depth + i} - p)
///
/// with S_i = ReachableSets::reach(trim, i, n - depth - i), the positions that exactly i steps from
/// the vertex' trim can lead to on paths that can still end in standstill at the horizon. The i-th
/// position of every path that a plan can hold lies in S_i, so e_i is at most its distance to the
/// reference point: each term bounds its own term of the cost, and h never exceeds the true
/// cost-to-go, with or without obstacles. The only assumption is that `reachable` was computed for
/// the same subgraph that is searched, from its edges: the sets include maneuvers that outrun both
/// their trims, several labels, speed limits and exit edges of disabled trims, and do not depend on
/// reference points and speeds.
///
/// `kStraightLine` takes d_i = i times the longest displacement of any edge of the subgraph (exit
/// edges too): admissible for the same automata, and much less tight.
///
/// `kReferenceSpeed` takes d_i from the reference speeds of the steps after `depth`: their sum over
/// the next i steps times the step length.
class CostToGoFunction {
 public:
  /// @param reachable, problem  must outlive this object
  /// @pre problem.horizon_steps() <= reachable.max_steps()
  /// @pre with kReferenceSpeed: one reference speed per step
  CostToGoFunction(const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
                   const HorizonProblem& problem, CostToGo kind);

  /// @param depth  steps already done, 0 ... n
  /// @pre `trim` is one of the subgraph's `start_trims` and can stand within the n - depth steps
  /// left
  [[nodiscard]] double operator()(TrimId trim, std::size_t depth, const Frame& frame) const;

 private:
  const automaton::ReachableSets& reachable_;
  std::span<const Point> reference_m_;
  CostToGo kind_;
  /// With kStraightLine d_1 ... d_n; with kReferenceSpeed one row of n per depth, of which n -
  /// depth are used.
  std::vector<double> reach_m_;
};

/// Lower bound on the cost of every plan of a problem [m^2], whatever orders the search:
/// `kReachable` at the start and the least cost of the maneuvers themselves.
/// @param reachable  for at least the problem's steps
[[nodiscard]] double least_cost_of_problem(const automaton::Subgraph& subgraph,
                                           const automaton::ReachableSets& reachable,
                                           const EdgeCosts& costs, const HorizonProblem& problem);

}  // namespace hlc::search
