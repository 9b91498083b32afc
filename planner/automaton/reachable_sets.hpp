#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "planner/automaton/subgraph.hpp"

namespace hlc::automaton {

/// Unit vectors n_0 ... n_15 at multiples of 22.5 degrees: the directions of Reach::support_m.
inline constexpr std::array<std::array<double, 2>, 16> kReachDirections = [] {
  constexpr double kDiagonal = std::numbers::sqrt2 / 2.0;
  constexpr double kCos = 0.92387953251128675613;  // cos 22.5 deg
  constexpr double kSin = 0.38268343236508977173;
  std::array<std::array<double, 2>, 16> directions{
      {{1.0, 0.0}, {kCos, kSin}, {kDiagonal, kDiagonal}, {kSin, kCos}}};
  for (std::size_t i = 4; i < 16; ++i) {
    directions[i] = {-directions[i - 4][1], directions[i - 4][0]};
  }
  return directions;
}();

/// Outer approximation of a set of positions, in the frame of the start pose: a circle around the
/// start and sixteen half-planes, n_i p <= s_i, contain it. All -infinity if the set is empty.
struct Reach {
  double max_distance_m{};             ///< d: of a position from the start
  std::array<double, 16> support_m{};  ///< s_i = max n_i p over the set
};

/// Reachable sets of a subgraph, in the frame of the start pose. Tables, computed once per
/// subgraph, for every trim that planning may start from (Subgraph::start_trims). For the paper's
/// 12 trims and 9 steps that takes 3 ms, for 95 trims with 5000 edges 0.7 s (Release, one core).
///
/// With T_tu the displacement of the edge t -> u, the sets after m steps follow from those before:
///
///     hull S(t, m) = hull of the union over the successors u of t of T_tu * hull S(u, m - 1)
///
/// so only hull vertices are propagated, without loss: a linear map takes hulls to hulls.
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
  [[nodiscard]] double max_distance_m(TrimId trim, std::size_t steps,
                                      std::size_t steps_left) const {
    return reach(trim, steps, steps_left).max_distance_m;
  }

  /// Outer approximation of the same positions: `max_distance_m` and the support in sixteen
  /// directions. Each number may be too large by `allowance_m(steps)`, none is too small.
  /// @pre steps <= max_steps
  [[nodiscard]] const Reach& reach(TrimId trim, std::size_t steps, std::size_t steps_left) const;

  /// Vertices of the convex hull of the same positions, counter-clockwise; the hull may omit what
  /// protrudes by less than `allowance_m(steps)`. Empty if no permitted path exists.
  /// @pre steps <= max_steps
  [[nodiscard]] std::span<const Point> positions_m(TrimId trim, std::size_t steps,
                                                   std::size_t steps_left) const;

  /// Bound on what the hulls of this many steps have omitted (kHullTolerance_m each, a few at a
  /// time), and rounding.
  [[nodiscard]] static constexpr double allowance_m(std::size_t steps) {
    return 10.0 * kHullTolerance_m * static_cast<double>(steps);
  }

  /// Largest distance to standstill of a trim that planning may start from; `steps_left` is capped
  /// at it.
  [[nodiscard]] std::size_t max_steps_left() const { return max_steps_left_; }

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
  void compute_reach(const Subgraph& subgraph, std::size_t steps_left);
  void compute_swept_areas(const Subgraph& subgraph);
  [[nodiscard]] std::size_t reach_index(TrimId trim, std::size_t steps,
                                        std::size_t steps_left) const;
  [[nodiscard]] std::size_t area_index(TrimId trim, std::size_t step) const;

  std::size_t max_steps_;
  std::size_t max_steps_left_{};
  std::vector<Reach> reach_;
  SetPerTrim positions_m_;  ///< one hull for each of `reach_`
  std::vector<ConvexPolygon> swept_area_m_;
  std::vector<ConvexPolygon> swept_area_until_m_;
  std::size_t num_trims_{};
  std::vector<std::vector<Shift>> shifts_;  ///< by trim; empty after the tables are computed
};

}  // namespace hlc::automaton
