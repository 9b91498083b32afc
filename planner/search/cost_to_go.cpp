#include "planner/search/cost_to_go.hpp"

#include <cassert>

#include "planner/common/demand.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::search {
namespace {

double longest_displacement_m(const automaton::Subgraph& subgraph) {
  double longest_m = 0.0;
  for (const TrimId trim : subgraph.start_trims()) {
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      longest_m = std::max(longest_m, edge.maneuver->displacement.position_m().norm());
    }
  }
  return longest_m;
}

}  // namespace

double distance_beyond_m(const Point& q_m, const automaton::Reach& reach) {
  double beyond_m = std::max(0.0, q_m.norm() - reach.max_distance_m);
  for (std::size_t i = 0; i < automaton::kReachDirections.size(); ++i) {
    const double along_m =
        automaton::kReachDirections[i][0] * q_m.x() + automaton::kReachDirections[i][1] * q_m.y();
    beyond_m = std::max(beyond_m, along_m - reach.support_m[i]);
  }
  return beyond_m;
}

double straight_line_cost_to_go(const Point& position_m, std::span<const Point> reference_m,
                                std::span<const double> reach_m) {
  assert(reference_m.size() == reach_m.size());  // per vertex
  double h = 0.0;
  for (std::size_t i = 0; i < reach_m.size(); ++i) {
    const double excess_m = std::max(0.0, (position_m - reference_m[i]).norm() - reach_m[i]);
    h += excess_m * excess_m;
  }
  return h;
}

double reference_speed_cost_to_go(const Point& position_m, std::span<const Point> reference_m,
                                  std::span<const double> reach_m) {
  assert(reference_m.size() == reach_m.size());  // per vertex
  double h = 0.0;
  for (std::size_t i = 0; i < reach_m.size(); ++i) {
    const double difference_m = (position_m - reference_m[i]).norm() - reach_m[i];
    h += difference_m * difference_m;
  }
  return h;
}

CostToGoFunction::CostToGoFunction(const automaton::Subgraph& subgraph,
                                   const automaton::ReachableSets& reachable,
                                   const HorizonProblem& problem, CostToGo kind)
    : reachable_(reachable), reference_m_(problem.reference_m), kind_(kind) {
  const std::size_t n = problem.horizon_steps();
  HLC_DEMAND(n <= reachable.max_steps(), n, reachable.max_steps());
  HLC_DEMAND(!needs_reference_speeds(kind) || problem.reference_speed_mps.size() == n, kind,
             problem.reference_speed_mps.size(), n);

  if (kind == CostToGo::kStraightLine) {
    const double longest_m = longest_displacement_m(subgraph);
    for (std::size_t i = 1; i <= n; ++i) {
      reach_m_.push_back(static_cast<double>(i) * longest_m +
                         automaton::ReachableSets::allowance_m(i));
    }
  }
  if (kind == CostToGo::kReferenceSpeed) {
    reach_m_.resize(n * n);
    for (std::size_t depth = 0; depth < n; ++depth) {
      double marched_m = 0.0;
      for (std::size_t i = 1; i <= n - depth; ++i) {
        marched_m += problem.reference_speed_mps[depth + i - 1] * subgraph.automaton().step_s;
        reach_m_[depth * n + i - 1] = marched_m;
      }
    }
  }
}

double CostToGoFunction::operator()(TrimId trim, std::size_t depth, const Frame& frame) const {
  const std::size_t n = reference_m_.size();
  const std::size_t steps_left = n - depth;
  const std::span<const Point> reference_m = reference_m_.subspan(depth);
  if (steps_left == 0) return 0.0;
  switch (kind_) {
    case CostToGo::kStraightLine:
      return straight_line_cost_to_go(frame.origin_m, reference_m, {&reach_m_[0], steps_left});
    case CostToGo::kReferenceSpeed:
      return reference_speed_cost_to_go(frame.origin_m, reference_m,
                                        {&reach_m_[depth * n], steps_left});
    case CostToGo::kReachable:
      break;
  }
  double h = 0.0;
  for (std::size_t i = 1; i <= steps_left; ++i) {
    const Point& reference = reference_m[i - 1];
    const double dx_m = reference.x() - frame.origin_m.x();
    const double dy_m = reference.y() - frame.origin_m.y();
    const Point q_m{frame.cos_heading * dx_m + frame.sin_heading * dy_m,
                    frame.cos_heading * dy_m - frame.sin_heading * dx_m};
    const double beyond_m = distance_beyond_m(q_m, reachable_.reach(trim, i, steps_left - i));
    h += beyond_m * beyond_m;
  }
  return h;
}

double least_cost_of_problem(const automaton::Subgraph& subgraph,
                             const automaton::ReachableSets& reachable, const EdgeCosts& costs,
                             const HorizonProblem& problem) {
  const std::size_t n = problem.horizon_steps();
  const CostToGoFunction cost_to_go(subgraph, reachable, problem, CostToGo::kReachable);
  return cost_to_go(problem.start_trim, 0, to_frame(problem.start)) +
         costs.to_go(problem.start_trim, n) + static_cast<double>(n) * costs.least();
}

}  // namespace hlc::search
