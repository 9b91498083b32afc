#include "planner/joint_search/prioritized.hpp"

#include <algorithm>
#include <numeric>

#include "planner/common/demand.hpp"

namespace hlc::joint_search {
namespace {

constexpr std::size_t kMostVehicles = 8;

}  // namespace

Order constant_order(std::size_t num_vehicles) {
  Order order(num_vehicles);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

Order most_collisions_first(const JointProblem& problem, const JointPlan& alone) {
  std::vector<std::vector<ConvexPolygon>> areas;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    areas.push_back(areas_of(alone[i], problem[i].problem));
  }
  std::vector<std::size_t> collisions(problem.size());
  for (std::size_t i = 0; i < problem.size(); ++i) {
    for (std::size_t k = 0; k < problem.size(); ++k) {
      if (k != i && meet(areas[i], areas[k])) ++collisions[i];
    }
  }
  Order order = constant_order(problem.size());
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::size_t i) { return collisions[i]; });
  return order;
}

JointPlan plan_alone(const JointProblem& problem) {
  JointPlan plans;
  for (const JointVehicle& one : problem) {
    plans.push_back(one.engine->search(one.problem));
    if (plans.back().maneuvers.empty()) return {};
  }
  return plans;
}

JointPlan plan_in_order(const JointProblem& problem, std::span<const std::size_t> order) {
  JointPlan plans(problem.size());
  std::vector<std::vector<ConvexPolygon>> before;
  for (const std::size_t i : order) {
    search::HorizonProblem one = problem[i].problem;
    for (const auto& areas_m : before) add_obstacles(areas_m, one);
    plans[i] = problem[i].engine->search(one);
    if (plans[i].maneuvers.empty()) return {};
    before.push_back(areas_of(plans[i], one));
  }
  return plans;
}

JointPlan plan_in_best_order(const JointProblem& problem) {
  HLC_DEMAND(problem.size() <= kMostVehicles, problem.size());
  Order order = constant_order(problem.size());
  JointPlan best;
  do {
    JointPlan plans = plan_in_order(problem, order);
    if (plans.empty()) continue;
    if (best.empty() || cost_of(plans) < cost_of(best)) best = std::move(plans);
  } while (std::ranges::next_permutation(order).found);
  return best;
}

}  // namespace hlc::joint_search
