#include "planner/maneuver_design/pareto_front.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "planner/maneuver_design/solver/shooting.hpp"
#include "planner/maneuver_design/solver/transcription.hpp"
#include "planner/maneuver_design/weighted_sum.hpp"

namespace hlc {
namespace {

constexpr double kNoRange = 1e-6;     // relative to the size of a criterion
constexpr double kDominance = 1e-6;   // relative to the range: less is the solver's noise
constexpr double kEvenEnough = 0.02;  // of the mean distance between neighbours
constexpr double kEqualCost = 1e-7;   // relative to the range: maneuvers as good as the optimum
constexpr double kWorthIt = 0.01;     // of the range, that another criterion must gain by a choice

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

/// The optimum of each criterion alone, and what they span.
struct SingleOptima {
  std::vector<ParetoPoint> points;
  ObjectiveRange range;

  [[nodiscard]] double width(std::size_t criterion) const {
    const auto i = static_cast<Eigen::Index>(criterion);
    return range.worst(i) - range.best(i);
  }
  /// True if the criteria contradict each other at all.
  [[nodiscard]] bool have_range() const {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto index = static_cast<Eigen::Index>(i);
      const double size = std::max(std::abs(range.best(index)), std::abs(range.worst(index)));
      if (!(width(i) > kNoRange * size)) {
        return false;
      }
    }
    return true;
  }
};

/// Adds a solution's status to that of the front; true if it is an optimum.
bool is_optimal(const ManeuverSolution& solution, ParetoFront& front) {
  if (solution.status != ManeuverStatus::kOptimal && front.status == ManeuverStatus::kOptimal) {
    front.status = solution.status;
    front.reason = solution.reason;
  }
  return solution.status == ManeuverStatus::kOptimal;
}

/// Counts solved problems for whoever watches.
class Counter {
 public:
  Counter(const ParetoProgress& progress, std::size_t of) : progress_(progress), of_(of) {}

  void count() {
    if (progress_) {
      progress_(++done_, of_);
    }
  }

 private:
  const ParetoProgress& progress_;
  std::size_t of_;
  std::size_t done_{};
};

/// The bound J_i <= max, its size that of the criterion's range.
CostBound bound_on(const ParetoProblem& problem, const SingleOptima& optima, std::size_t criterion,
                   double max) {
  return {problem.criteria[criterion], max, optima.width(criterion)};
}

/// Where maneuvers that differ are equally good for a criterion, the one among them that is best
/// for another criterion, if it is clearly better there: else the ends would not belong to the
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

/// Range of the criteria over the single optima.
ObjectiveRange range_over(const SingleOptima& optima) {
  std::vector<Objectives> objectives;
  for (const ParetoPoint& point : optima.points) objectives.push_back(point.objectives);
  return range_of(objectives);
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

void mark_dominated(const SingleOptima& optima, ParetoFront& front) {
  const Objectives tolerance = kDominance * (optima.range.worst - optima.range.best);
  for (ParetoPoint& point : front.points) {
    point.is_dominated = true;
  }
  for (const std::size_t i : non_dominated(front.objectives(), tolerance)) {
    front.points[i].is_dominated = false;
  }
}

/// min J_1 subject to J_i <= eps_i; `eps` starts with i = 2.
ManeuverSolution bounded(const ParetoProblem& problem, const SingleOptima& optima,
                         const std::vector<double>& eps, const std::vector<Input>& start) {
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

/// Length along a front up to each point, criteria divided by their ranges.
std::vector<double> lengths_along(const std::vector<Objectives>& points,
                                  const ObjectiveRange& range) {
  std::vector<double> lengths{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Objectives step = (points[i] - points[i - 1]).cwiseQuotient(range.worst - range.best);
    lengths.push_back(lengths.back() + step.norm());
  }
  return lengths;
}

/// J_2 at equally spaced lengths, without the ends, by linear interpolation. `points` run from one
/// end of the front to the other.
std::vector<double> evenly_spaced(const std::vector<Objectives>& points,
                                  const ObjectiveRange& range, std::size_t count) {
  const std::vector<double> lengths = lengths_along(points, range);
  std::vector<double> result;
  std::size_t piece = 0;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double wanted = lengths.back() * static_cast<double>(i) / static_cast<double>(count - 1);
    while (piece + 2 < lengths.size() && lengths[piece + 1] < wanted) {
      ++piece;
    }
    const double share = (wanted - lengths[piece]) / (lengths[piece + 1] - lengths[piece]);
    result.push_back(points[piece](1) + share * (points[piece + 1](1) - points[piece](1)));
  }
  return result;
}

bool is_even(const std::vector<Objectives>& points, const ObjectiveRange& range) {
  const std::vector<double> lengths = lengths_along(points, range);
  const double mean = lengths.back() / static_cast<double>(lengths.size() - 1);
  for (std::size_t i = 1; i < lengths.size(); ++i) {
    if (std::abs(lengths[i] - lengths[i - 1] - mean) > kEvenEnough * mean) {
      return false;
    }
  }
  return true;
}

/// Two criteria: the known point that keeps the bound on J_2 and is best in J_1, if that is clearly
/// less than `cost`.
const ParetoPoint* better_known(const std::vector<ParetoPoint>& known, double bound, double cost,
                                const SingleOptima& optima) {
  const ParetoPoint* best = nullptr;
  for (const ParetoPoint& point : known) {
    const double least =
        best != nullptr ? best->objectives(0) : cost - kDominance * optima.width(0);
    if (point.objectives(1) <= bound && point.objectives(0) < least) best = &point;
  }
  return best;
}

/// Two criteria: the point with that bound on J_2, started from the better of two neighbours.
/// @param gain  share of the range of J_1 that makes it worth while
void improve(const ParetoProblem& problem, const SingleOptima& optima, double bound,
             const ParetoPoint& neighbour, double gain, ParetoPoint& point) {
  ParetoPoint other =
      point_of(problem, bounded(problem, optima, {bound}, neighbour.solution.inputs));
  const bool is_better = other.solution.status == ManeuverStatus::kOptimal &&
                         other.objectives(0) < point.objectives(0) - gain * optima.width(0);
  if (is_better) point = std::move(other);
}

/// Two criteria: from the optimum of J_2 over the bounds `eps` (ascending) to the optimum of J_1.
/// Each point starts from the one before, and once more from a known one that is better than what
/// came of that: then it was a local optimum, and those before may be, too. Then, and whenever
/// asked to, the way goes back once, each point started from the one after it, the optimum of J_2
/// too.
void sweep(const ParetoProblem& problem, SingleOptima& optima, const std::vector<double>& eps,
           const std::vector<ParetoPoint>& known, bool goes_back, Counter& counter,
           ParetoFront& front) {
  front.points = {optima.points[1]};
  for (const double bound : eps) {
    ManeuverSolution solution =
        bounded(problem, optima, {bound}, front.points.back().solution.inputs);
    const double cost = solution.status == ManeuverStatus::kOptimal
                            ? solution.cost
                            : std::numeric_limits<double>::infinity();
    if (const ParetoPoint* better = better_known(known, bound, cost, optima)) {
      solution = bounded(problem, optima, {bound}, better->solution.inputs);
      goes_back = true;
    }
    counter.count();
    if (!is_optimal(solution, front)) {
      return;
    }
    front.points.push_back(point_of(problem, std::move(solution)));
  }
  front.points.push_back(optima.points[0]);
  if (!goes_back) return;
  for (std::size_t i = eps.size(); i > 0; --i) {
    improve(problem, optima, eps[i - 1], front.points[i + 1], kDominance, front.points[i]);
  }
  const double least = front.points[0].objectives(1) + kEqualCost * optima.width(1);
  improve(problem, optima, least, front.points[1], kWorthIt, front.points[0]);
  optima.points[1] = front.points[0];
  optima.range = range_over(optima);
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

/// Two criteria: where weighted sums lie, in order along the front, ends included.
std::vector<ParetoPoint> rough_front(const ParetoProblem& problem, const SingleOptima& optima,
                                     std::size_t points, Counter& counter) {
  std::vector<ParetoPoint> rough{optima.points[1]};
  for (std::size_t i = 1; i + 1 < points; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(points - 1);
    ParetoPoint point = point_of(problem, weighted(problem, optima, {share, 1.0 - share}));
    counter.count();
    const bool goes_on = point.solution.status == ManeuverStatus::kOptimal &&
                         point.objectives(1) > rough.back().objectives(1) &&
                         point.objectives(1) < optima.points[0].objectives(1);
    if (goes_on) rough.push_back(std::move(point));
  }
  rough.push_back(optima.points[0]);
  return rough;
}

void fill_two_criteria(const ParetoProblem& problem, SingleOptima& optima,
                       const ParetoOptions& options, ParetoFront& front) {
  constexpr std::size_t kCorrections = 4;
  const std::size_t inner = options.points - 2;
  Counter counter(options.progress,
                  inner * (options.spacing == Spacing::kAlongFront ? 2 + kCorrections : 2));
  std::vector<ParetoPoint> known = rough_front(problem, optima, options.points, counter);
  if (options.spacing == Spacing::kSecondCriterion) {
    sweep(problem, optima, equal_steps(optima, 1, options.points), known, true, counter, front);
    return;
  }
  std::vector<Objectives> course;
  for (const ParetoPoint& point : known) course.push_back(point.objectives);
  for (std::size_t i = 0; i <= kCorrections; ++i) {
    sweep(problem, optima, evenly_spaced(course, optima.range, options.points), known, i == 0,
          counter, front);
    course = front.objectives();
    if (front.status != ManeuverStatus::kOptimal || is_even(course, optima.range)) {
      return;
    }
    known.insert(known.end(), front.points.begin(), front.points.end());
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
  Counter counter(options.progress, combinations);
  for_each_combination(lists, [&](const std::vector<double>& eps) {
    ManeuverSolution solution = bounded(problem, optima, eps, {});
    counter.count();
    if (solution.status != ManeuverStatus::kInfeasible && is_optimal(solution, front)) {
      front.points.push_back(point_of(problem, std::move(solution)));
    }
  });
}

/// All ways to share `left` pieces of 1 / total among the criteria.
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
  Counter counter(options.progress, all.size());
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
  assert(problem.criteria.size() >= 2 && options.points >= 2);
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

}  // namespace hlc
