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

using PredictionPointer = std::shared_ptr<const coordination::Prediction>;

/// Plans in one order after the other. The plan of a vehicle depends on its predecessors and their
/// predictions only, so each is made once and taken again wherever these are the same: in orders
/// with the same begin, and in those that differ far from the vehicle.
class OrderTrials {
 public:
  explicit OrderTrials(std::span<Controller* const> component) : component_(component) {
    for (const Controller* one : component_) {
      members_.push_back(
          {.before = std::make_shared<const Controller::Coupled>(one->coupled_state())});
    }
    const Controller& any = *component_.front();
    for (const VehicleId vehicle : any.coupling().vehicles()) {
      traffic_.push_back(&any.traffic_of(vehicle));
    }
  }

  [[nodiscard]] OrderCost plan(const std::vector<VehicleId>& order, const OrderCost* to_beat) {
    const coordination::PriorityOrder plans_before =
        order.size() == 1 ? coordination::PriorityOrder(order) : as_priorities(order);
    std::vector<VehicleId> sequence = order;
    std::ranges::sort(sequence, std::cref(plans_before));  // PriorityRule::first comes first
    predictions_ = {};
    OrderCost cost;
    cost.costs_m2.resize(order.size(), std::numeric_limits<double>::infinity());
    double rest_m2 = 0.0;
    for (const VehicleId vehicle : order) rest_m2 += alone_m2(vehicle);
    for (const VehicleId vehicle : sequence) {
      rest_m2 -= alone_m2(vehicle);
      const KnownPlan& known = plan_of(vehicle, plans_before, cost.expanded);
      predictions_.put(known.prediction);
      if (!known.cost_m2) ++cost.without_plan;
      cost.cost_m2 += known.cost_m2.value_or(0.0);
      const auto at = std::ranges::find(order, vehicle) - order.begin();
      cost.costs_m2[static_cast<std::size_t>(at)] =
          known.cost_m2.value_or(std::numeric_limits<double>::infinity());
      if (to_beat != nullptr && !can_be_better(cost, rest_m2, *to_beat)) {
        cost.without_plan = order.size();
        break;
      }
    }
    return cost;
  }

  /// All members after their plans in this order, which has been tried.
  void take(const std::vector<VehicleId>& order) {
    std::size_t unused = 0;
    const coordination::PriorityOrder plans_before = as_priorities(order);
    const auto levels =
        coordination::computation_levels(component_.front()->coupling(), plans_before);
    std::vector<VehicleId> sequence = order;
    std::ranges::sort(sequence, std::cref(plans_before));
    predictions_ = {};
    for (const VehicleId vehicle : sequence) {
      predictions_.put(plan_of(vehicle, plans_before, unused).prediction);
      Controller& one = *component_[place(vehicle)];
      Member& member = members_[place(vehicle)];
      if (member.known[member.wanted].after) {
        one.restore(*std::exchange(member.known[member.wanted].after, std::nullopt));
      }
      one.plan_in(plans_before, levels.at(vehicle));
      one.keep_plan(member.before);
    }
  }

 private:
  /// @param rest_m2  that the rest costs at least
  static bool can_be_better(const OrderCost& so_far, double rest_m2, const OrderCost& to_beat) {
    if (so_far.without_plan != to_beat.without_plan) {
      return so_far.without_plan < to_beat.without_plan;
    }
    return so_far.cost_m2 + rest_m2 < to_beat.cost_m2;
  }

  struct KnownPlan {
    std::vector<PredictionPointer> respected;  ///< by vehicle; equal ones are the same object
    PredictionPointer prediction;
    std::optional<double> cost_m2;
    /// Of the controller; none: it is in that state.
    std::optional<Controller::Coupled> after{};
  };
  struct Member {
    std::shared_ptr<const Controller::Coupled> before;
    std::vector<KnownPlan> known{};
    std::size_t wanted{};   ///< index of the plan last asked for
    std::size_t current{};  ///< of the one that the controller is after, if any
  };

  /// @param expanded  increased by what the plan takes, if it is not known
  const KnownPlan& plan_of(VehicleId vehicle, const coordination::PriorityOrder& plans_before,
                           std::size_t& expanded) {
    Controller& one = *component_[place(vehicle)];
    Member& member = members_[place(vehicle)];
    std::vector<PredictionPointer> respected;
    for (const VehicleId other :
         coordination::predecessors(one.coupling(), vehicle, plans_before)) {
      respected.push_back(predictions_.find(other, one.last_step()));
    }
    const auto same = std::ranges::find(member.known, respected, &KnownPlan::respected);
    member.wanted = static_cast<std::size_t>(same - member.known.begin());
    if (same != member.known.end()) return *same;
    if (!member.known.empty()) {
      member.known[member.current].after = one.take_state();
      one.restore(*member.before);
    }
    one.plan_in(plans_before, 0);
    auto prediction = std::make_shared<const coordination::Prediction>(one.plan(predictions_));
    for (const KnownPlan& known : member.known) {
      if (*known.prediction == *prediction) prediction = known.prediction;
    }
    member.current = member.wanted;
    expanded += coordination::kExpansionsPerPlan + one.expanded();
    return member.known.emplace_back(KnownPlan{.respected = std::move(respected),
                                               .prediction = std::move(prediction),
                                               .cost_m2 = one.planned_cost_m2()});
  }

  /// What the vehicle costs at least, as far as it has been planned alone.
  [[nodiscard]] double alone_m2(VehicleId vehicle) const {
    for (const KnownPlan& known : members_[place(vehicle)].known) {
      if (known.respected.empty()) return known.cost_m2.value_or(0.0);
    }
    return 0.0;
  }

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
  std::vector<Member> members_;
  std::vector<const coordination::Traffic*> traffic_;
  coordination::ReceivedMessages<coordination::Prediction> predictions_;  ///< in the current order
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
  trials.take(search(any.coupling(), start,
                     [&trials](const std::vector<VehicleId>& order, const OrderCost* to_beat) {
                       return trials.plan(order, to_beat);
                     }));
}

}  // namespace hlc::controller
