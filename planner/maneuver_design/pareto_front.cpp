#include "planner/maneuver_design/pareto_front.hpp"

#include "planner/common/demand.hpp"
#include "planner/maneuver_design/pareto_subproblems.hpp"
#include "planner/maneuver_design/two_criteria_front.hpp"

namespace hlc::maneuver_design {
namespace {

void mark_dominated(const SingleOptima& optima, ParetoFront& front) {
  const Objectives tolerance = kDominanceTolerance * (optima.range.worst - optima.range.best);
  for (ParetoPoint& point : front.points) {
    point.is_dominated = true;
  }
  for (const std::size_t i : non_dominated(front.objectives(), tolerance)) {
    front.points[i].is_dominated = false;
  }
}

/// Calls `visit` with every combination of one value of each list.
void for_each_combination(const std::vector<std::vector<double>>& lists,
                          const std::function<void(const std::vector<double>&)>& visit) {
  std::vector<std::size_t> index(lists.size(), 0);
  std::vector<double> values(lists.size());
  for (;;) {
    for (std::size_t i = 0; i < lists.size(); ++i) {
      values[i] = lists[i][index[i]];
    }
    visit(values);
    std::size_t digit = 0;
    while (digit < lists.size() && ++index[digit] == lists[digit].size()) {
      index[digit++] = 0;
    }
    if (digit == lists.size()) {
      return;
    }
  }
}

void fill_grid(const ParetoProblem& problem, SingleOptima& optima, const ParetoOptions& options,
               ParetoFront& front) {
  front.points = optima.points;
  std::vector<std::vector<double>> lists;
  std::size_t combinations = 1;
  for (std::size_t i = 1; i < problem.criteria.size(); ++i) {
    lists.push_back(equal_steps(optima, i, options.points));
    lists.back().push_back(optima.range.worst(static_cast<Eigen::Index>(i)));
    combinations *= lists.back().size();
  }
  ProgressCounter counter(options.progress, combinations);
  for_each_combination(lists, [&](const std::vector<double>& eps) {
    ManeuverSolution solution = bounded(problem, optima, eps, {});
    counter.count();
    if (solution.status != ManeuverStatus::kInfeasible && is_optimal(solution, front)) {
      front.points.push_back(point_of(problem, std::move(solution)));
    }
  });
}

/// All ways to distribute `left` pieces of 1 / total among the criteria.
void add_weights(std::size_t left, std::size_t total, std::size_t criteria,
                 std::vector<double>& weights, std::vector<std::vector<double>>& all) {
  if (weights.size() + 1 == criteria) {
    weights.push_back(static_cast<double>(left) / static_cast<double>(total));
    all.push_back(weights);
    weights.pop_back();
    return;
  }
  for (std::size_t share = 0; share <= left; ++share) {
    weights.push_back(static_cast<double>(share) / static_cast<double>(total));
    add_weights(left - share, total, criteria, weights, all);
    weights.pop_back();
  }
}

void fill_weighted(const ParetoProblem& problem, SingleOptima& optima, const ParetoOptions& options,
                   ParetoFront& front) {
  std::vector<double> weights;
  std::vector<std::vector<double>> all;
  add_weights(options.points - 1, options.points - 1, problem.criteria.size(), weights, all);
  ProgressCounter counter(options.progress, all.size());
  for (const std::vector<double>& choice : all) {
    ManeuverSolution solution = weighted(problem, optima, choice);
    counter.count();
    if (is_optimal(solution, front)) {
      front.points.push_back(point_of(problem, std::move(solution)));
    }
  }
}

using Fill = void (*)(const ParetoProblem&, SingleOptima&, const ParetoOptions&, ParetoFront&);

/// The points that `fill` finds between the optima of the single criteria, which it may improve.
ParetoFront front_by(Fill fill, const ParetoProblem& problem, const ParetoOptions& options) {
  HLC_DEMAND(problem.criteria.size() >= 2 && options.points >= 2, problem.criteria.size(),
             options.points);
  ParetoFront front;
  SingleOptima optima = single_optima(problem, front);
  if (front.status != ManeuverStatus::kOptimal) {
    return front;
  }
  if (!optima.have_range()) {
    front.points = {optima.points.front()};
    return front;
  }
  fill(problem, optima, options, front);
  mark_dominated(optima, front);
  return front;
}

}  // namespace

std::vector<Objectives> ParetoFront::objectives() const {
  std::vector<Objectives> result;
  for (const ParetoPoint& point : points) {
    result.push_back(point.objectives);
  }
  return result;
}

ParetoFront epsilon_constraint_front(const ParetoProblem& problem, const ParetoOptions& options) {
  return front_by(problem.criteria.size() == 2 ? fill_two_criteria : fill_grid, problem, options);
}

ParetoFront weighted_sum_front(const ParetoProblem& problem, const ParetoOptions& options) {
  return front_by(fill_weighted, problem, options);
}

}  // namespace hlc::maneuver_design
