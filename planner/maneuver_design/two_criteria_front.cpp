#include "planner/maneuver_design/two_criteria_front.hpp"

#include <cmath>
#include <limits>

namespace hlc::maneuver_design {
namespace {

constexpr double kEvenEnough = 0.02;  // of the mean distance between neighbours

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
        best != nullptr ? best->objectives(0) : cost - kDominanceTolerance * optima.width(0);
    if (point.objectives(1) <= bound && point.objectives(0) < least) best = &point;
  }
  return best;
}

/// Two criteria: the point with that bound on J_2, started from the better of two neighbours.
/// @param gain  required gain as a share of the range of J_1
void improve(const ParetoProblem& problem, const SingleOptima& optima, double bound,
             const ParetoPoint& neighbour, double gain, ParetoPoint& point) {
  ParetoPoint other =
      point_of(problem, bounded(problem, optima, {bound}, neighbour.solution.inputs));
  const bool is_better = other.solution.status == ManeuverStatus::kOptimal &&
                         other.objectives(0) < point.objectives(0) - gain * optima.width(0);
  if (is_better) point = std::move(other);
}

/// Two criteria: from the optimum of J_2 over the bounds `eps` (ascending) to the optimum of J_1.
/// Each point starts from the one before, and once more from a known better one if the result is
/// worse than that: then the result was a local optimum, and those before it may be, too. Then, and
/// whenever requested, a backward pass follows, each point started from the one after it, including
/// the optimum of J_2.
void sweep(const ParetoProblem& problem, SingleOptima& optima, const std::vector<double>& eps,
           const std::vector<ParetoPoint>& known, bool goes_back, ProgressCounter& counter,
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
    improve(problem, optima, eps[i - 1], front.points[i + 1], kDominanceTolerance, front.points[i]);
  }
  const double least = front.points[0].objectives(1) + kEqualCost * optima.width(1);
  improve(problem, optima, least, front.points[1], kWorthIt, front.points[0]);
  optima.points[1] = front.points[0];
  optima.range = range_over(optima);
}

/// Two criteria: the weighted sums, in order along the front, ends included.
std::vector<ParetoPoint> rough_front(const ParetoProblem& problem, const SingleOptima& optima,
                                     std::size_t points, ProgressCounter& counter) {
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

}  // namespace

void fill_two_criteria(const ParetoProblem& problem, SingleOptima& optima,
                       const ParetoOptions& options, ParetoFront& front) {
  constexpr std::size_t kCorrections = 4;
  const std::size_t inner = options.points - 2;
  ProgressCounter counter(options.progress,
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

}  // namespace hlc::maneuver_design
