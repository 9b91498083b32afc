#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "planner/automaton/automaton.hpp"
#include "planner/maneuver_design/path_constraint.hpp"
#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// Range of a free duration. @pre 0 < min_s <= max_s
struct DurationRange {
  double min_s{};
  double max_s{};
};

/// Bound on another cost of the same maneuver: integral of its running cost <= max. Used by the
/// epsilon-constraint method for Pareto fronts.
struct CostBound {
  std::shared_ptr<const RunningCost> cost;
  double max{};
  double size{};  ///< of differences in this cost that count; 0: |max|, or 1 if that is 0 too

  /// Scale of the bound.
  [[nodiscard]] double scale() const {
    if (size > 0.0) return size;
    return max != 0.0 ? std::abs(max) : 1.0;
  }
};

/// Optimal control problem of one maneuver (paper, Eq. 2):
///
///     min J = integral_0^T l(x, u) dt             over u, and over T if it is free
///     u is constant on each of N intervals of equal length
///     x' = f(x, u)                                single-track model, one Runge-Kutta step each
///     (v, delta)(0) = from, (v, delta)(T) = to    pose: starts at the origin, is free at the end
///     |u_v| <= a_max, |u_delta| <= rate_max
///     v_min <= v <= v_max, |delta| <= delta_max
///     g_i(x, u) <= 0                              optional, such as a friction circle
///     J_i <= max_i                                optional, bounds on other costs
///
/// v and delta are integrals of u, so the end conditions and the bounds on states are linear in u,
/// and bounds that hold at the interval bounds hold everywhere. g is required at both ends of each
/// interval with the interval's input; inside an interval it may exceed 0 by its curvature there,
/// O((T / N)^2).
struct ManeuverProblem {
  automaton::Trim from;
  automaton::Trim to;
  double duration_s{0.2};  ///< T; where the search starts if T is free
  std::size_t intervals{20};
  vehicle::VehicleParameters vehicle;
  vehicle::VehicleLimits limits;
  std::optional<DurationRange> free_duration{};                           ///< absent: T is fixed
  std::vector<std::shared_ptr<const PathConstraint>> path_constraints{};  ///< g_i
  std::vector<CostBound> cost_bounds{};
};

/// The start state of every maneuver.
[[nodiscard]] vehicle::State start_state(const ManeuverProblem& problem);

/// One of the two inputs with the state that it drives: u_v and v, or u_delta and delta.
struct Channel {
  Eigen::Index index;  ///< of the input in u
  double from;
  double to;
  double input_max;
  double state_min;
  double state_max;

  [[nodiscard]] double change() const { return to - from; }
  /// Scale of the states, for tolerances.
  [[nodiscard]] double scale() const { return state_max; }
};

[[nodiscard]] Channel speed_channel(const ManeuverProblem& problem);
[[nodiscard]] Channel steering_channel(const ManeuverProblem& problem);

}  // namespace hlc::maneuver_design
