#include "tests/support/plan_check.hpp"

#include <algorithm>
#include <cmath>

namespace hlc::test {
namespace {

bool is_switched_on(const automaton::Maneuver* maneuver, TrimId from,
                    const automaton::Subgraph& subgraph) {
  const auto edges = subgraph.successors(from);
  return std::any_of(edges.begin(), edges.end(),
                     [&](const automaton::Edge& edge) { return edge.maneuver == maneuver; });
}

bool are_close(const Pose& a, const Pose& b) {
  return (a.position_m() - b.position_m()).norm() < 1e-9 &&
         std::abs(a.heading_rad - b.heading_rad) < 1e-9;
}

}  // namespace

bool is_free(const automaton::Maneuver& maneuver, const Pose& start, std::size_t step,
             const search::HorizonProblem& problem) {
  const bool moves = maneuver.from != maneuver.to || maneuver.displacement.x_m != 0.0 ||
                     maneuver.displacement.y_m != 0.0 || maneuver.displacement.heading_rad != 0.0;
  const ConvexPolygon swept_m = transformed(maneuver.swept_area_m, start);
  for (const auto* const areas_m : {&problem.obstacles_m, &problem.avoided_in_motion_m}) {
    const bool counts = areas_m == &problem.obstacles_m || moves;
    if (!counts || areas_m->empty()) continue;
    const bool is_met = std::ranges::any_of(
        (*areas_m)[step - 1],
        [&swept_m](const ConvexPolygon& area_m) { return intersects(swept_m, area_m); });
    if (is_met) return false;
  }
  if (!problem.boundary_m.empty()) {
    const ConvexPolygon lane_m = transformed(maneuver.lane_area_m, start);
    for (const Segment& segment : problem.boundary_m) {
      if (intersects(lane_m, segment)) {
        return false;
      }
    }
  }
  return true;
}

double weighted_criteria(const automaton::Maneuver& maneuver,
                         const std::vector<search::PlanningWeight>& weights) {
  double cost = 0.0;
  for (const search::PlanningWeight& weight : weights) {
    for (const CriterionValue& criterion : maneuver.criteria) {
      if (criterion.name == weight.criterion) cost += weight.weight_m2 * criterion.value;
    }
  }
  return cost;
}

double position_cost_m2(const search::HorizonProblem& problem, std::size_t step,
                        const Point& position_m) {
  const Point error_m = position_m - problem.reference_m[step - 1];
  const Point c = problem.contouring.empty() ? Point::Zero() : problem.contouring[step - 1];
  const double across = c.x() * error_m.x() + c.y() * error_m.y();
  return error_m.x() * error_m.x() + error_m.y() * error_m.y() + across * across;
}

namespace {

std::string error_of_step(const automaton::Maneuver& maneuver, const Pose& from, std::size_t step,
                          const search::HorizonProblem& problem) {
  const bool may_turn = step == 1 && problem.may_turn_in_place;
  if (search::turns_in_place(maneuver) && !may_turn) return "wheels turned in place";
  return is_free(maneuver, from, step, problem) ? "" : "collision";
}

}  // namespace

std::string validate(const search::SearchResult& result, const automaton::Subgraph& subgraph,
                     const search::HorizonProblem& problem,
                     const std::vector<search::PlanningWeight>& weights) {
  const std::size_t n = problem.horizon_steps();
  if (result.status != search::SearchStatus::kOptimal &&
      result.status != search::SearchStatus::kUnproven) {
    return "no plan";
  }
  if (result.maneuvers.size() != n || result.poses.size() != n) {
    return "size is not the horizon";
  }
  Pose pose = problem.start;
  TrimId trim = problem.start_trim;
  double cost = 0.0;
  for (std::size_t step = 1; step <= n; ++step) {
    const std::string at = " in step " + std::to_string(step);
    const automaton::Maneuver* maneuver = result.maneuvers[step - 1];
    if (!is_switched_on(maneuver, trim, subgraph)) return "edge is not switched on" + at;
    if (const std::string error = error_of_step(*maneuver, pose, step, problem); !error.empty()) {
      return error + at;
    }
    pose = compose(pose, maneuver->displacement);
    trim = maneuver->to;
    if (!are_close(pose, result.poses[step - 1])) {
      return "pose differs" + at;
    }
    cost +=
        position_cost_m2(problem, step, pose.position_m()) + weighted_criteria(*maneuver, weights);
  }
  if (!subgraph.automaton().trims[trim.index].is_equilibrium()) {
    return "does not stand at the end";
  }
  return std::abs(cost - result.cost) < 1e-9 ? "" : "cost differs";
}

}  // namespace hlc::test
