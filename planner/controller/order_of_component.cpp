#include "planner/controller/order_of_component.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace hlc::controller {
namespace {

using coordination::OrderCost;

class OrderTrials {
 public:
  explicit OrderTrials(std::span<Controller* const> component) : component_(component) {
    for (const Controller* one : component_) states_.push_back(one->coupled_state());
    const Controller& any = *component_.front();
    for (const VehicleId vehicle : any.coupling().vehicles()) {
      traffic_.push_back(&any.traffic_of(vehicle));
    }
  }

  [[nodiscard]] OrderCost plan(const std::vector<VehicleId>& order) {
    const coordination::PriorityOrder plans_before = as_priorities(order);
    std::vector<VehicleId> sequence = order;
    std::ranges::sort(sequence, std::cref(plans_before));  // PriorityRule::first comes first
    coordination::ReceivedMessages<coordination::Prediction> predictions;
    OrderCost cost;
    cost.costs_m2.resize(order.size());
    for (const VehicleId vehicle : sequence) {
      Controller& one = *component_[place(vehicle)];
      one.restore(states_[place(vehicle)]);
      one.plan_in(plans_before, 0);
      predictions.put(std::make_shared<const coordination::Prediction>(one.plan(predictions)));
      const std::optional<double> cost_m2 = one.planned_cost_m2();
      if (!cost_m2) ++cost.without_plan;
      cost.cost_m2 += cost_m2.value_or(0.0);
      const auto at = std::ranges::find(order, vehicle) - order.begin();
      cost.costs_m2[static_cast<std::size_t>(at)] =
          cost_m2.value_or(std::numeric_limits<double>::infinity());
      cost.expanded += 1 + one.expanded();
    }
    return cost;
  }

  /// As before all trials, but with this order.
  void take(const std::vector<VehicleId>& order) {
    const coordination::PriorityOrder plans_before = as_priorities(order);
    const auto levels =
        coordination::computation_levels(component_.front()->coupling(), plans_before);
    for (std::size_t i = 0; i < component_.size(); ++i) {
      Controller& one = *component_[i];
      one.restore(states_[i]);
      one.plan_in(plans_before, levels.at(one.options().vehicle));
    }
  }

 private:
  [[nodiscard]] coordination::PriorityOrder as_priorities(
      const std::vector<VehicleId>& order) const {
    const Controller& any = *component_.front();
    return any.options().strategies.priorities.in_order(
        {.graph = any.coupling(), .traffic = traffic_}, order);
  }

  [[nodiscard]] std::size_t place(VehicleId vehicle) const {
    const auto found = std::ranges::lower_bound(
        component_, vehicle, {}, [](const Controller* one) { return one->options().vehicle; });
    return static_cast<std::size_t>(found - component_.begin());
  }

  std::span<Controller* const> component_;
  std::vector<Controller::Coupled> states_;
  std::vector<const coordination::Traffic*> traffic_;
};

}  // namespace

void choose_order(std::span<Controller* const> component) {
  if (component.size() < 2) return;
  const Controller& any = *component.front();
  const coordination::SearchOrder search =
      any.options().strategies.priorities.search_for(component.size());
  if (search == nullptr || !std::ranges::all_of(component, &Controller::is_settled)) return;
  std::vector<VehicleId> start;
  for (const Controller* one : component) start.push_back(one->options().vehicle);
  std::ranges::sort(start, std::cref(any.plans_before()));
  OrderTrials trials(component);
  trials.take(search(any.coupling(), start, [&trials](const std::vector<VehicleId>& order) {
    return trials.plan(order);
  }));
}

}  // namespace hlc::controller
