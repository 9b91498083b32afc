#pragma once

#include <cstddef>
#include <vector>

#include "planner/automaton/subgraph.hpp"

namespace hlc {

/// What a subgraph can reach, in the frame of the start pose. Tables, computed once per subgraph,
/// for every trim that planning may start from (Subgraph::starts). For the paper's 12 trims and 9
/// steps that takes 3 ms,
/// for 95 trims with 5000 edges 0.7 s (Release, one core).
///
/// With T_tu the displacement of the edge t -> u, the sets after m steps follow from those after m
/// - 1:
///
///     hull S(t, m) = hull of the union over the successors u of t of T_tu * hull S(u, m - 1)
///
/// so only hull vertices are carried on, and nothing is lost by it: a linear map takes hulls to
/// hulls.
///
/// A path is *permitted* with `steps_left` steps still to go after it if its last trim's distance
/// to standstill is at most `steps_left` (recursive feasibility: every plan ends in standstill).
class ReachableSets {
 public:
  ReachableSets(const Subgraph& subgraph, std::size_t max_steps);

  [[nodiscard]] std::size_t max_steps() const { return max_steps_; }

  /// Largest distance between the start and the position after exactly `steps` steps from `trim`
  /// over all permitted paths with `steps_left` steps still to go [m]; computed from the convex
  /// hull of the reachable positions, which is exact because a distance is largest at a vertex of
  /// the hull. -infinity if no permitted path exists. `steps_left` beyond the largest distance to
  /// standstill is capped.
  /// -infinity too for a trim that planning cannot start from.
  /// @pre steps <= max_steps
  [[nodiscard]] double max_distance_m(TrimId trim, std::size_t steps, std::size_t steps_left) const;

  /// Convex area that contains every swept area of the step number `step` (1: the first) of every
  /// path from `trim`, whether it can still stop afterwards or not. step = 0: the swept area of
  /// standing at the start, with the heading differences of `trim`. Empty for a trim that planning
  /// cannot start from.
  /// @pre step <= max_steps
  [[nodiscard]] const ConvexPolygon& swept_area_m(TrimId trim, std::size_t step) const;

  /// Convex area that contains the swept areas of all steps 0 ... `steps`.
  [[nodiscard]] const ConvexPolygon& swept_area_until_m(TrimId trim, std::size_t steps) const;

 private:
  using SetPerTrim = std::vector<std::vector<Point>>;
  /// T_tu of one edge t -> u.
  struct Shift {
    TrimId to;
    Point origin_m;
    double cos_heading;
    double sin_heading;
  };

  [[nodiscard]] std::vector<Point> hull_over_successors(TrimId trim,
                                                        const SetPerTrim& sets_m) const;
  void compute_distances(const Subgraph& subgraph, std::size_t steps_left);
  void compute_swept_areas(const Subgraph& subgraph);
  [[nodiscard]] std::size_t distance_index(TrimId trim, std::size_t steps,
                                           std::size_t steps_left) const;
  [[nodiscard]] std::size_t area_index(TrimId trim, std::size_t step) const;

  std::size_t max_steps_;
  std::size_t max_steps_left_{};
  std::vector<double> max_distance_m_;
  std::vector<ConvexPolygon> swept_area_m_;
  std::vector<ConvexPolygon> swept_area_until_m_;
  std::size_t num_trims_{};
  std::vector<std::vector<Shift>> shifts_;  ///< by trim; empty once the tables are there
};

}  // namespace hlc
