#pragma once

#include <limits>
#include <string>
#include <vector>

#include "planner/automaton/automaton.hpp"
#include "planner/maneuver_design/running_cost.hpp"

namespace hlc {

/// Optimal control problem of one maneuver (paper, Eq. 2) for a fixed duration T:
///
///     min J = integral_0^T l(x, u) dt        over u, constant on each of N intervals of equal
///     length x' = f(x, u)                           single-track model, one Runge-Kutta step per
///     interval (v, delta)(0) = from,  (v, delta)(T) = to      the pose starts at the origin and is
///     free at the end |u_v| <= a_max,  |u_delta| <= rate_max,  v_min <= v <= v_max,  |delta| <=
///     delta_max
///
/// v and delta are integrals of u, so the end conditions and the bounds on states are linear in u,
/// and bounds that hold at the interval bounds hold everywhere.
struct ManeuverProblem {
  Trim from;
  Trim to;
  double duration_s{0.2};
  std::size_t intervals{20};
  VehicleParameters vehicle;
  VehicleLimits limits;
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
  kOptimal,       ///< a local optimum within the tolerances
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
};

struct ManeuverSolution {
  ManeuverStatus status{ManeuverStatus::kNotConverged};
  std::string reason;  ///< empty if kOptimal; names the bound that is violated if kInfeasible
  /// Shortest duration in which the inputs' bounds allow the change of speed and steering [s];
  /// infinite if a trim itself lies outside the bounds on states.
  double shortest_duration_s{std::numeric_limits<double>::infinity()};
  std::vector<Input> inputs;  ///< N; empty if kInfeasible
  std::vector<State> states;  ///< N + 1; empty if kInfeasible
  double cost{};              ///< J
  ConstraintResiduals residuals;
  int evaluations{};  ///< of the cost
};

/// Solves the problem with NLopt's SLSQP (sequential quadratic programming).
///
/// The inputs are scaled by their bounds and the cost by its value at the guess, because SLSQP
/// takes a raw cost of 1e-3 for converged at once. Bounds on states are added only if a solution
/// without them violates them: most maneuvers do not, and 4 (N - 1) more constraints make the
/// solver 2-3 times slower.
///
/// @pre intervals >= 1, duration_s > 0
[[nodiscard]] ManeuverSolution solve(const ManeuverProblem& problem, const RunningCost& cost,
                                     const SolverOptions& options = {});

}  // namespace hlc
