#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/automaton.hpp"
#include "planner/maneuver_design/path_constraint.hpp"
#include "planner/maneuver_design/running_cost.hpp"

namespace hlc {

/// Range of a free duration. @pre 0 < min_s <= max_s
struct DurationRange {
  double min_s{};
  double max_s{};
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
///
/// v and delta are integrals of u, so the end conditions and the bounds on states are linear in u,
/// and bounds that hold at the interval bounds hold everywhere. g is asked for at both ends of each
/// interval with the interval's input; inside an interval it may exceed 0 by what it bends there,
/// O((T / N)^2).
struct ManeuverProblem {
  Trim from;
  Trim to;
  double duration_s{0.2};  ///< T; where the search starts if T is free
  std::size_t intervals{20};
  VehicleParameters vehicle;
  VehicleLimits limits;
  std::optional<DurationRange> free_duration{};                           ///< absent: T is fixed
  std::vector<std::shared_ptr<const PathConstraint>> path_constraints{};  ///< g_i
};

/// Where the search for an optimum starts.
enum class Guess {
  kConstant,  ///< constant input
  kBangBang,  ///< full acceleration and steering rate first, then the opposite, so that the ends
              ///< meet
};

struct SolverOptions {
  Guess guess{Guess::kConstant};
  /// Stops if the cost changes by less than this, relative.
  double cost_tolerance{1e-12};
  int max_evaluations{2000};
};

enum class ManeuverStatus {
  kOptimal,       ///< a local optimum: constraints hold, first-order residual at most 1e-3
  kInfeasible,    ///< no input within the bounds connects the trims in that duration
  kNotConverged,  ///< the solver stopped without meeting its tolerances
};

/// How far the solution violates each kind of constraint, 0 if it holds.
struct ConstraintResiduals {
  double end_speed_mps{};
  double end_steering_rad{};
  double acceleration_mps2{};
  double steering_rate_radps{};
  double speed_mps{};
  double steering_rad{};
  double path{};  ///< the largest g_i; g has no unit
};

struct ManeuverSolution {
  ManeuverStatus status{ManeuverStatus::kNotConverged};
  std::string reason;  ///< empty if kOptimal; names the bound that is violated if kInfeasible
  /// Shortest duration in which the inputs' bounds allow the change of speed and steering [s];
  /// infinite if a trim itself lies outside the bounds on states or violates a g_i. If a g_i makes
  /// the pair infeasible, it is the shortest one that was found with it.
  double shortest_duration_s{std::numeric_limits<double>::infinity()};
  std::vector<Input> inputs;             ///< N; empty if kInfeasible
  std::vector<State> states;             ///< N + 1; empty if kInfeasible
  double duration_s{};                   ///< T
  double cost{};                         ///< J
  std::vector<CriterionValue> criteria;  ///< of all criteria, in the order of their names
  ConstraintResiduals residuals;
  /// Of the first-order conditions of optimality, relative to the slope of the cost, in variables
  /// scaled by their bounds (see first_order.hpp). A bound counts as active within 1e-6.
  double first_order_residual{};
  int evaluations{};  ///< of the cost
};

/// Solves the problem with NLopt's SLSQP (sequential quadratic programming).
///
/// The inputs are scaled by their bounds, a free duration by its guess and the cost by its value at
/// the guess, because SLSQP takes a raw cost of 1e-3 for converged at once. Bounds on states and
/// g_i are added only if a solution without them violates them: most maneuvers do not, and each
/// constraint at each interval makes the solver slower (4 (N - 1) bounds: 2-3 times). Where it
/// stops with a first-order residual above 1e-5 it is started again from there.
///
/// @pre intervals >= 1, duration_s > 0
[[nodiscard]] ManeuverSolution solve(const ManeuverProblem& problem, const RunningCost& cost,
                                     const SolverOptions& options = {});

}  // namespace hlc
