#include "planner/maneuver_design/solver/maneuver_solver.hpp"

#include <fmt/format.h>

#include <optional>

#include "planner/common/demand.hpp"
#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/effort.hpp"
#include "planner/maneuver_design/feasibility.hpp"
#include "planner/maneuver_design/shooting.hpp"
#include "planner/maneuver_design/solver/attempt.hpp"
#include "planner/maneuver_design/solver/optimality.hpp"
#include "planner/maneuver_design/solver/starting_point.hpp"
#include "planner/maneuver_design/travel_time.hpp"

namespace hlc::maneuver_design {
namespace {

constexpr double kFirstOrderTolerance = 1e-3;  // relative to the slope of the cost

/// Status of a point.
ManeuverSolution solution_at(const Candidate& point, const Transcription& transcription) {
  const ManeuverProblem& problem = transcription.problem();
  ManeuverSolution solution;
  solution.inputs = transcription.variables().inputs(point.z);
  solution.duration_s = transcription.variables().duration_s(point.z);
  Shot shot = shoot(start_state(problem), solution.inputs, solution.duration_s,
                    transcription.running_cost(), problem.vehicle, WithGradient::kNo);
  solution.states = std::move(shot.states);
  solution.cost = shot.cost;
  solution.residuals = residuals_of(problem, solution.inputs, solution.states, solution.duration_s);
  Eigen::VectorXd gradient;
  (void)transcription.cost(point.z, &gradient);
  solution.first_order_residual = first_order_residual_at(transcription, point.z, gradient);
  return solution;
}

void value_all_criteria(const ManeuverProblem& problem, ManeuverSolution& solution) {
  for (const std::string& name : criterion_names()) {
    const auto criterion = make_criterion(name, problem.vehicle);
    solution.criteria.push_back(
        {name, shoot(start_state(problem), solution.inputs, solution.duration_s, *criterion,
                     problem.vehicle, WithGradient::kNo)
                   .cost});
  }
}

/// Why a result is no solution; empty if it is one.
std::string complaint(const ManeuverProblem& problem, const ManeuverSolution& solution,
                      const Candidate& point) {
  if (!point.reason.empty()) {
    return point.reason;
  }
  if (!within_tolerance(solution.residuals, problem.limits)) {
    return "the solver's result violates a constraint";
  }
  if (solution.first_order_residual > kFirstOrderTolerance) {
    return fmt::format("the solver stopped where the first-order residual is {:g}, must be <= {:g}",
                       solution.first_order_residual, kFirstOrderTolerance);
  }
  return {};
}

/// Solves the problem; does not analyse why g_i cannot be satisfied.
ManeuverSolution attempt(const ManeuverProblem& problem, const RunningCost& cost,
                         const SolverOptions& options) {
  HLC_DEMAND(problem.intervals >= 1 && problem.duration_s > 0.0, problem.intervals,
             problem.duration_s);
  const Feasibility feasibility = feasibility_of(problem);
  if (!feasibility.reason.empty()) {
    ManeuverSolution none;
    none.status = ManeuverStatus::kInfeasible;
    none.reason = feasibility.reason;
    none.shortest_duration_s = feasibility.shortest_duration_s;
    return none;
  }
  Attempt attempt(problem, cost, options,
                  guessed_duration_s(problem, feasibility.shortest_duration_s));
  const Candidate point = attempt.solved();
  ManeuverSolution solution = solution_at(point, attempt.transcription());
  solution.evaluations = attempt.evaluations();
  solution.shortest_duration_s = feasibility.shortest_duration_s;
  solution.reason = complaint(problem, solution, point);
  solution.status =
      solution.reason.empty() ? ManeuverStatus::kOptimal : ManeuverStatus::kNotConverged;
  value_all_criteria(problem, solution);
  return solution;
}

/// The fastest maneuver that satisfies the g_i, not slower than `longest_s`; not optimal if it was
/// not found from any of several durations.
ManeuverSolution fastest_from(const ManeuverProblem& problem, double longest_s) {
  SolverOptions from_constant;
  from_constant.guess = Guess::kConstant;
  ManeuverSolution found;
  for (const double ample : {3.0, 10.0, 1.5, 30.0}) {
    ManeuverProblem fastest = problem;
    fastest.cost_bounds.clear();
    fastest.duration_s = ample * longest_s;
    fastest.free_duration = DurationRange{longest_s, 2.0 * ample * longest_s};
    found = attempt(fastest, TravelTime{}, from_constant);
    if (found.status == ManeuverStatus::kOptimal) {
      break;
    }
  }
  return found;
}

/// For a problem whose g_i the solver could not satisfy, determines the duration that they need.
/// Makes the solution an infeasible one if that exceeds the bound.
void explain_path_violation(const ManeuverProblem& problem, ManeuverSolution& solution) {
  const double longest_s =
      problem.free_duration ? problem.free_duration->max_s : problem.duration_s;
  const ManeuverSolution found = fastest_from(problem, longest_s);
  if (found.status != ManeuverStatus::kOptimal ||
      found.duration_s <= longest_s * (1.0 + kPathTolerance)) {
    return;
  }
  std::string reason;
  for (const auto& constraint : problem.path_constraints) {
    reason +=
        fmt::format("{} does not allow the change in {:g} s; ", constraint->name(), longest_s);
  }
  reason += fmt::format("shortest feasible duration {:g} s", found.duration_s);
  const int evaluations = solution.evaluations + found.evaluations;
  solution = {};
  solution.status = ManeuverStatus::kInfeasible;
  solution.reason = reason;
  solution.shortest_duration_s = found.duration_s;
  solution.evaluations = evaluations;
}

/// Once more, from the maneuver of least effort, if that satisfies the constraints.
void try_again_from_least_effort(const ManeuverProblem& problem, const RunningCost& cost,
                                 const SolverOptions& options, ManeuverSolution& solution) {
  ManeuverProblem unbounded = problem;
  unbounded.cost_bounds.clear();
  const ManeuverSolution soft = attempt(unbounded, Effort{}, {});
  solution.evaluations += soft.evaluations;
  if (soft.status == ManeuverStatus::kOptimal) {
    const int evaluations = solution.evaluations;
    SolverOptions from_soft = options;
    from_soft.start = soft.inputs;
    solution = attempt(problem, cost, from_soft);
    solution.evaluations += evaluations;
  }
}

/// The minimum of the cost in `bound`, under the other bounds of `problem`, if it exceeds the
/// bound: then an infeasible solution, with the reason.
std::optional<ManeuverSolution> broken_bound(const ManeuverProblem& problem,
                                             const CostBound& bound) {
  const ManeuverSolution least = attempt(problem, *bound.cost, {});
  const bool is_kept = least.cost <= bound.max + kPathTolerance * bound.scale();
  if (least.status != ManeuverStatus::kOptimal || is_kept) return std::nullopt;
  ManeuverSolution none;
  none.status = ManeuverStatus::kInfeasible;
  none.reason =
      fmt::format("a cost that is bounded by {:g} is at least {:g}{}", bound.max, least.cost,
                  problem.cost_bounds.empty() ? "" : " under the bounds on other costs");
  none.evaluations = least.evaluations;
  return none;
}

/// For a problem whose bounds on other costs the solver could not keep, determines how low those
/// costs can be: each alone, then each under the bounds before it. Makes the solution an infeasible
/// one if that exceeds a bound.
void explain_cost_bound(const ManeuverProblem& problem, ManeuverSolution& solution) {
  const auto is_broken_under_first = [&](std::size_t others, const CostBound& bound) {
    ManeuverProblem bounded = problem;
    bounded.cost_bounds.resize(others);
    std::optional<ManeuverSolution> none = broken_bound(bounded, bound);
    if (!none) return false;
    none->evaluations += solution.evaluations;
    solution = *std::move(none);
    return true;
  };
  for (const CostBound& bound : problem.cost_bounds) {
    if (is_broken_under_first(0, bound)) return;
  }
  for (std::size_t i = 1; i < problem.cost_bounds.size(); ++i) {
    if (is_broken_under_first(i, problem.cost_bounds[i])) return;
  }
}

}  // namespace

ManeuverSolution solve(const ManeuverProblem& problem, const RunningCost& cost,
                       const SolverOptions& options) {
  ManeuverSolution solution = attempt(problem, cost, options);
  if (solution.status == ManeuverStatus::kNotConverged && options.start.empty()) {
    try_again_from_least_effort(problem, cost, options, solution);
  }
  if (solution.residuals.cost_bound > kPathTolerance) {
    explain_cost_bound(problem, solution);
  }
  if (solution.residuals.path > kPathTolerance) {
    explain_path_violation(problem, solution);
  }
  return solution;
}

}  // namespace hlc::maneuver_design
