#pragma once

#include <limits>
#include <string>
#include <vector>

#include "planner/automaton/automaton.hpp"
#include "planner/maneuver_design/feasibility.hpp"
#include "planner/maneuver_design/maneuver_problem.hpp"
#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// Starting point of the search for an optimum.
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
  std::vector<vehicle::Input> start{};
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

struct ManeuverSolution {
  ManeuverStatus status{ManeuverStatus::kNotConverged};
  std::string reason;  ///< empty if kOptimal; names the bound that is violated if kInfeasible
  /// Shortest duration in which the inputs' bounds permit the change of speed and steering [s];
  /// infinite if a trim itself lies outside the bounds on states or violates a g_i. If a g_i makes
  /// the pair infeasible, it is the shortest one found with it.
  double shortest_duration_s{std::numeric_limits<double>::infinity()};
  std::vector<vehicle::Input> inputs;    ///< N; empty if kInfeasible
  std::vector<vehicle::State> states;    ///< N + 1; empty if kInfeasible
  double duration_s{};                   ///< T
  double cost{};                         ///< J
  std::vector<CriterionValue> criteria;  ///< of all criteria, in the order of their names
  ConstraintResiduals residuals;
  /// Of the first-order conditions of optimality, relative to the slope of the cost, in variables
  /// scaled by their bounds (see first_order.hpp). A bound counts as active within 1e-6.
  double first_order_residual{};
  int evaluations{};  ///< of the cost
};

/// Solves the problem: NLopt's SLSQP (sequential quadratic programming) finds the region, Newton's
/// method the last digits; see attempt.hpp. The same problem gives the same bits.
///
/// **Tie-break.** J1 is so flat in the steering that inputs whose J1 differs by 1e-6 end
/// millimetres apart. The minimised objective is therefore J / |J at the start| + tie_break
/// mean(z^2), z the inputs divided by their bounds: of equally good maneuvers the one of least
/// effort. The second term is at most `tie_break`, so J is within tie_break |J| of its optimum
/// (1e-6; measured 1e-9 for J1, nothing for J2 and J3), and mirrored trims get mirrored maneuvers
/// to about 1e-12. `cost` is J alone.
///
/// The result is a local optimum, not certainly the global one; for the criteria except
/// stopping_distance random starts have found no better one (multi_start_test.cpp).
/// Stopping_distance is tried from all 15 courses of Guess::kBest, and has been found up to 1e-3
/// from better ones.
///
/// @pre intervals >= 1, duration_s > 0; options.start empty or of N inputs
[[nodiscard]] ManeuverSolution solve(const ManeuverProblem& problem, const RunningCost& cost,
                                     const SolverOptions& options = {});

}  // namespace hlc::maneuver_design
