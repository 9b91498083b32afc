#include "planner/controller/shared_step.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace hlc::controller {
namespace {

/// Equal in all that couplings and priorities depend on.
bool couples_alike(const coordination::Traffic* a, const coordination::Traffic* b) {
  const auto compared = [](const coordination::Traffic& one) {
    return std::tie(one.vehicle, one.step, one.next_pose, one.reachable_area_m, one.standing_steps,
                    one.reference_areas_m);
  };
  return a == b || compared(*a) == compared(*b);
}

}  // namespace

const SharedStep::Coupling& SharedStep::coupling(std::vector<const coordination::Traffic*> traffic,
                                                 const coordination::PriorityRule& priorities,
                                                 const coordination::CouplingRule& rule) {
  std::ranges::sort(traffic, {}, [](const coordination::Traffic* one) { return one->vehicle; });
  if (!coupling_ || priorities != priorities_ || &rule != rule_ ||
      !std::ranges::equal(traffic, traffic_, couples_alike)) {
    traffic_ = traffic;
    priorities_ = priorities;
    rule_ = &rule;
    coordination::CouplingGraph graph(std::move(traffic), rule);
    coordination::PriorityOrder order = priorities.assign({.graph = graph, .traffic = traffic_});
    auto levels = coordination::computation_levels(graph, order);
    coupling_.emplace(std::move(graph), std::move(order), std::move(levels));
  }
  return *coupling_;
}

const std::vector<right_of_way::Taken>& SharedStep::taken(
    const right_of_way::ConflictMap& map, const std::vector<right_of_way::Holder>& holders,
    std::span<const right_of_way::Blocked> blocked, double look_ahead_m,
    const right_of_way::GrantOrder& order) {
  const bool is_known = taken_ && taken_->map == &map && taken_->holders == holders &&
                        std::ranges::equal(taken_->blocked, blocked) &&
                        taken_->look_ahead_m == look_ahead_m && taken_->order == &order;
  if (!is_known) {
    taken_.emplace(
        &map, holders, std::vector<right_of_way::Blocked>(blocked.begin(), blocked.end()),
        look_ahead_m, &order,
        right_of_way::leave_a_way_on(
            map, holders, right_of_way::grant(map, holders, blocked, look_ahead_m, order), blocked,
            order));
  }
  return taken_->taken;
}

}  // namespace hlc::controller
