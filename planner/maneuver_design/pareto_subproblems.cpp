#include "planner/maneuver_design/pareto_subproblems.hpp"

#include <algorithm>
#include <cmath>

#include "planner/maneuver_design/shooting.hpp"
#include "planner/maneuver_design/weighted_sum.hpp"

namespace hlc::maneuver_design {
namespace {

constexpr double kNoRange = 1e-6;  // relative to the size of a criterion

/// The bound J_i <= max, scaled by the criterion's range.
CostBound bound_on(const ParetoProblem& problem, const SingleOptima& optima, std::size_t criterion,
                   double max) {
  return {problem.criteria[criterion], max, optima.width(criterion)};
}

/// Where different maneuvers are equally good for a criterion, the one among them that is best for
/// another criterion, if it is clearly better there: otherwise the ends would not belong to the
/// front.
void choose_among_equals(const ParetoProblem& problem, SingleOptima& optima) {
  for (std::size_t i = 0; i < problem.criteria.size(); ++i) {
    for (std::size_t other = 0; other < problem.criteria.size(); ++other) {
      if (other == i) continue;
      const auto index = static_cast<Eigen::Index>(other);
      ParetoPoint& point = optima.points[i];
      ManeuverProblem maneuver = problem.maneuver;
      maneuver.cost_bounds.push_back(
          bound_on(problem, optima, i,
                   point.objectives(static_cast<Eigen::Index>(i)) + kEqualCost * optima.width(i)));
      SolverOptions options;
      options.start = point.solution.inputs;
      ParetoPoint choice = point_of(problem, solve(maneuver, *problem.criteria[other], options));
      const bool is_better =
          choice.solution.status == ManeuverStatus::kOptimal &&
          choice.objectives(index) < point.objectives(index) - kWorthIt * optima.width(other);
      if (is_better) point = std::move(choice);
    }
  }
}

}  // namespace

double SingleOptima::width(std::size_t criterion) const {
  const auto i = static_cast<Eigen::Index>(criterion);
  return range.worst(i) - range.best(i);
}

bool SingleOptima::have_range() const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const double size = std::max(std::abs(range.best(index)), std::abs(range.worst(index)));
    if (!(width(i) > kNoRange * size)) {
      return false;
    }
  }
  return true;
}

SingleOptima single_optima(const ParetoProblem& problem, ParetoFront& front) {
  SingleOptima optima;
  for (const auto& criterion : problem.criteria) {
    optima.points.push_back(point_of(problem, solve(problem.maneuver, *criterion)));
    if (!is_optimal(optima.points.back().solution, front)) {
      return optima;
    }
  }
  optima.range = range_over(optima);
  if (optima.have_range()) {
    choose_among_equals(problem, optima);
    optima.range = range_over(optima);
  }
  return optima;
}

ObjectiveRange range_over(const SingleOptima& optima) {
  std::vector<Objectives> objectives;
  for (const ParetoPoint& point : optima.points) objectives.push_back(point.objectives);
  return range_of(objectives);
}

ParetoPoint point_of(const ParetoProblem& problem, ManeuverSolution solution) {
  ParetoPoint point;
  point.objectives.resize(static_cast<Eigen::Index>(problem.criteria.size()));
  for (std::size_t i = 0; i < problem.criteria.size() && !solution.inputs.empty(); ++i) {
    point.objectives(static_cast<Eigen::Index>(i)) =
        shoot(start_state(problem.maneuver), solution.inputs, solution.duration_s,
              *problem.criteria[i], problem.maneuver.vehicle, WithGradient::kNo)
            .cost;
  }
  point.solution = std::move(solution);
  return point;
}

bool is_optimal(const ManeuverSolution& solution, ParetoFront& front) {
  if (solution.status != ManeuverStatus::kOptimal && front.status == ManeuverStatus::kOptimal) {
    front.status = solution.status;
    front.reason = solution.reason;
  }
  return solution.status == ManeuverStatus::kOptimal;
}

ManeuverSolution bounded(const ParetoProblem& problem, const SingleOptima& optima,
                         const std::vector<double>& eps, const std::vector<vehicle::Input>& start) {
  ManeuverProblem maneuver = problem.maneuver;
  for (std::size_t i = 0; i < eps.size(); ++i) {
    maneuver.cost_bounds.push_back(bound_on(problem, optima, i + 1, eps[i]));
  }
  SolverOptions options;
  options.start = start;
  ManeuverSolution solution = solve(maneuver, *problem.criteria.front(), options);
  if (solution.status != ManeuverStatus::kOptimal) {
    solution = solve(maneuver, *problem.criteria.front());
  }
  return solution;
}

ManeuverSolution weighted(const ParetoProblem& problem, const SingleOptima& optima,
                          const std::vector<double>& weights) {
  std::vector<WeightedCost> terms;
  std::vector<CriterionRange> ranges;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    terms.push_back({weights[i], problem.criteria[i]});
    ranges.push_back({optima.range.best(index), optima.range.worst(index)});
  }
  return solve(problem.maneuver, normalised_sum(std::move(terms), ranges));
}

std::vector<double> equal_steps(const SingleOptima& optima, std::size_t criterion,
                                std::size_t points) {
  std::vector<double> steps;
  for (std::size_t i = 1; i + 1 < points; ++i) {
    steps.push_back(optima.range.best(static_cast<Eigen::Index>(criterion)) +
                    optima.width(criterion) * static_cast<double>(i) /
                        static_cast<double>(points - 1));
  }
  return steps;
}

}  // namespace hlc::maneuver_design
