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

/// Bound on another cost of the same maneuver: integral of its running cost <= max. What the
/// epsilon-constraint method for Pareto fronts adds.
struct CostBound {
  std::shared_ptr<const RunningCost> cost;
  double max{};
  double size{};  ///< of differences in this cost that count; 0: |max|, or 1 if that is 0 too

  /// What the bound is scaled by.
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
  std::vector<CostBound> cost_bounds{};
};

/// Where the search for an optimum starts.
enum class Guess {
  kBest,  ///< the cheapest of 15 courses: speed and steering each as linear ramp, as high as
          ///< the bounds allow at every time, as low, and steering high, then low, and vice versa
  kConstant,  ///< constant input
  kBangBang,  ///< full acceleration and steering rate first, then the opposite, so that the ends
              ///< meet
};

struct SolverOptions {
  Guess guess{Guess::kBest};
  /// Inputs to start from instead of a guess, N; clamped to their bounds. Empty: the guess.
  std::vector<Input> start{};
  /// Stops if the cost changes by less than this, relative.
  double cost_tolerance{1e-12};
  int max_evaluations{2000};  ///< of the cost, in one run of SLSQP; Newton takes up to 40 rounds
  /// Weight of the tie-break, see `solve`.
  double tie_break{1e-6};
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
  double path{};        ///< the largest g_i; g has no unit
  double cost_bound{};  ///< of J_i <= max_i, relative to CostBound::scale
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

/// Solves the problem: NLopt's SLSQP (sequential quadratic programming) finds the way, Newton's
/// method the last digits; see attempt.hpp. The same problem gives the same bits.
///
/// **Tie-break.** J1 is so flat in the steering that inputs whose J1 differs by 1e-6 end
/// millimetres apart. What is minimised is therefore J / |J at the start| + tie_break mean(z^2), z
/// the inputs divided by their bounds: of equally good maneuvers the one of least effort. The
/// second term is at most `tie_break`, so J is within tie_break |J| of its optimum (1e-6; measured
/// 1e-9 for J1, nothing for J2 and J3), and mirrored trims get mirrored maneuvers to about 1e-12.
/// `cost` is J alone.
///
/// A local optimum is found, not surely the best one; for the criteria but stopping_distance random
/// starts have found no better one (multi_start_test.cpp). Stopping_distance is tried from all 15
/// courses of Guess::kBest, and has been found up to 1e-3 from better ones.
///
/// @pre intervals >= 1, duration_s > 0; options.start empty or of N inputs
[[nodiscard]] ManeuverSolution solve(const ManeuverProblem& problem, const RunningCost& cost,
                                     const SolverOptions& options = {});

}  // namespace hlc
