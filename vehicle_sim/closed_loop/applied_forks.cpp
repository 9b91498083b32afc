#include "vehicle_sim/closed_loop/applied_forks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <variant>

#include "planner/common/demand.hpp"
#include "planner/coordination/priority.hpp"
#include "planner/geometry/footprint.hpp"

namespace hlc::closed_loop {
namespace {

/// @pre it is not gone
template <class Members>
auto& member_of(VehicleId vehicle, Members& members) {
  const auto member = std::ranges::find(members, vehicle.value, &Member::id);
  HLC_DEMAND(member != members.end(), vehicle.value);
  return *member;
}

}  // namespace

/// The changes of one step.
struct AppliedForks::Step {
  StepIndex now;
  std::uint64_t from;  ///< of the experiment
  std::vector<Member>& members;
  controller::JointStepRules& rules;
  std::set<VehicleId>& gone;
  const std::vector<road::DrivableRoute>& routes;  ///< the scenario's

  void apply(const Fork::Priorities& change) const {
    for (Member& member : members) {
      controller::Controller& controller = member.hlc.controller();
      coordination::PriorityRule priorities = controller.options().strategies.priorities;
      priorities.first = change.first;
      controller.coordinate_by(priorities, controller.options().strategies.coordination);
    }
  }

  void apply(const Fork::Coordination& change) const {
    for (Member& member : members) {
      controller::Controller& controller = member.hlc.controller();
      controller.coordinate_by(controller.options().strategies.priorities, change.rule);
    }
  }

  void apply(const Fork::Without& change) const {
    std::erase_if(members, [&](const Member& one) { return one.id == change.vehicle.value; });
    gone.insert(change.vehicle);
  }

  void apply(const Fork::Lost& change) const {
    rules.is_lost = [former = rules.is_lost, change, from = now](const controller::Delivery& one) {
      const bool is_now = one.step >= from && one.step.value < from.value + change.steps;
      return (is_now && one.from == change.from && one.to == change.to) || (former && former(one));
    };
  }

  /// No vehicle is to be on its way into it: it can no longer stop.
  void apply(const Fork::Obstacle& change) const {
    const ConvexPolygon area_m = footprint_area({change.length_m, change.width_m}, change.pose);
    for (Member& member : members) {
      controller::Controller& controller = member.hlc.controller();
      if (controller.will_meet(area_m)) {
        throw std::invalid_argument(fmt::format(
            "--set: obstacle= at ({}, {}) from step {}, must be clear of vehicle {} and of where "
            "it is going to stop",
            change.pose.x_m, change.pose.y_m, from, member.id));
      }
      controller.add_obstacle(area_m);
    }
  }

  void apply(const Fork::Route& change) const {
    controller::Controller& controller = member_of(change.vehicle, members).hlc.controller();
    controller.change_route(*std::ranges::find(routes, change.name, &road::DrivableRoute::name));
    if (controller.fits_route()) return;
    const road::Placement& placement = controller.placement().value();
    throw std::invalid_argument(
        fmt::format("--set: route={}:{} from step {}, must be a route that vehicle {} fits there: "
                    "it is {:.2f} m beside its path, turned by {:.2f} rad",
                    change.vehicle.value, change.name, from, change.vehicle.value,
                    placement.distance_m, placement.turned_rad));
  }

  /// In requests_.
  void apply(const Fork::Labels& /*change*/) const {}
  void apply(const Fork::MaxSpeed& /*change*/) const {}
};

AppliedForks::AppliedForks(std::vector<Fork> forks, const scenario::Scenario& scenario,
                           const std::vector<Member>& members)
    : forks_(std::move(forks)), scenario_(&scenario) {
  std::ranges::stable_sort(forks_, {}, &Fork::from);
  prepare_requests(members);
}

void AppliedForks::prepare_requests(const std::vector<Member>& members) {
  std::map<VehicleId, SubgraphRequest> so_far;
  for (const Fork& fork : forks_) {
    std::set<VehicleId> changed;
    for (const Fork::Change& change : fork.changes) {
      if (const auto* const labels = std::get_if<Fork::Labels>(&change)) {
        so_far[labels->vehicle].labels = labels->labels;
        changed.insert(labels->vehicle);
      } else if (const auto* const speed = std::get_if<Fork::MaxSpeed>(&change)) {
        so_far[speed->vehicle].max_speed_mps = speed->max_speed_mps;
        changed.insert(speed->vehicle);
      }
    }
    for (const VehicleId vehicle : changed) {
      const Member& member = member_of(vehicle, members);
      const controller::ControllerOptions& options = member.hlc.controller().options();
      try {
        requests_[{fork.from, vehicle}] = std::make_shared<const policy::PreparedChoice>(
            member.choice.base(), so_far.at(vehicle), member.choice.limits_mps(),
            options.horizon_steps, options.search);
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("--set of vehicle {} from step {}: {}",
                                                vehicle.value, fork.from, error.what()));
      }
    }
  }
}

void AppliedForks::apply(std::uint64_t from, StepIndex now, std::vector<Member>& members,
                         controller::JointStepRules& rules) {
  const Step step{.now = now,
                  .from = from,
                  .members = members,
                  .rules = rules,
                  .gone = gone_,
                  .routes = scenario_->routes};
  for (const Fork& fork : forks_) {
    if (fork.from != from) continue;
    for (const Fork::Change& change : fork.changes) {
      std::visit([&](const auto& one) { step.apply(one); }, change);
    }
  }
  for (const auto& [at, request] : requests_) {
    if (at.first != from || gone_.contains(at.second)) continue;
    member_of(at.second, members).choice.ask(request);
  }
}

}  // namespace hlc::closed_loop
