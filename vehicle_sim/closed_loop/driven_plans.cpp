#include "vehicle_sim/closed_loop/driven_plans.hpp"

#include <algorithm>
#include <string>

#include "planner/coordination/commit.hpp"
#include "vehicle_sim/closed_loop/invariants.hpp"

namespace hlc::closed_loop {
namespace {

constexpr std::size_t kKeptCommands = 16;  // more than a command's lifetime, copy included

}  // namespace

void DrivenPlans::commanded(const TrajectoryCommand& command) {
  Car& car = cars_[{command.vehicle_id}];
  car.is_told_to_stand = command.points.empty();
  if (!car.sent.empty() && car.sent.back().create == command.create_stamp) return;  // the copy
  car.sent.push_back({.create = command.create_stamp, .plan = nullptr});
  if (car.sent.size() > kKeptCommands) car.sent.pop_front();
}

bool DrivenPlans::has_newest_plan(const Car& car) {
  const AgreedPlan newest = plan_of(car, car.newest_valid);
  return car.num_agreed == 0 || (newest && newest->number == car.agreed->number);
}

void DrivenPlans::published(const Traffic& traffic) {
  Car& car = cars_[traffic.vehicle];
  if (!has_newest_plan(car) && !car.mistaken_since) car.mistaken_since = traffic.step;
}

void DrivenPlans::reported(const Report& report, const Plan* in_force) {
  Car& car = cars_[report.vehicle];
  if (report.status == StepStatus::kPlanned) {
    Agreed agreed{.number = ++car.num_agreed, .step = report.step, .areas = std::nullopt};
    if (car.predicted && car.predicted->step == report.step) agreed.areas = car.predicted->areas;
    car.agreed = std::make_shared<const Agreed>(std::move(agreed));
  } else if (in_force != nullptr && is_anchored(*in_force) &&
             car.agreed->step != in_force->first()) {
    car.agreed = std::make_shared<const Agreed>(Agreed{.number = car.num_agreed,
                                                       .step = in_force->first(),
                                                       .areas = in_force->areas_from(report.step)});
  }
  if (report.reason == FallbackReason::kDeviation || report.status == StepStatus::kStandby) {
    car.mistaken_since.reset();
  }
  for (Sent& sent : car.sent) {
    if (!sent.plan) sent.plan = car.agreed;
  }
}

void DrivenPlans::received(const TrajectoryCommand& command) {
  Car& car = cars_[{command.vehicle_id}];
  car.received.emplace_back(command.valid_after_stamp, command.create_stamp);
}

void DrivenPlans::died(VehicleId vehicle, Nanoseconds at) {
  Car& car = cars_[vehicle];
  car.out_of_reach_until = at + kAfterwards;
  car.driven = nullptr;
  car.follows = 0;
  car.received.clear();
}

DrivenPlans::AgreedPlan DrivenPlans::plan_of(const Car& car, Nanoseconds create) {
  const auto found = std::ranges::find(car.sent, create, &Sent::create);
  return found == car.sent.end() ? nullptr : found->plan;
}

bool DrivenPlans::has_dropped_plan(const Car& car, Nanoseconds tick) const {
  const AgreedPlan newest = plan_of(car, car.newest_valid);
  if (car.follows != 0 || car.is_told_to_stand || !newest || !newest->areas) return false;
  const bool has_run_out =
      tick / period_ >= newest->areas->first.value + newest->areas->areas_m.size();
  return !has_run_out && tick >= car.newest_valid + kCommandLifetime;
}

bool DrivenPlans::is_out_of_reach(VehicleId vehicle, Nanoseconds at) const {
  const auto car = cars_.find(vehicle);
  return car != cars_.end() && at < car->second.out_of_reach_until;
}

bool DrivenPlans::is_judged(VehicleId vehicle, const Car& car, Nanoseconds tick) const {
  return car.follows != 0 && car.driven && car.driven->areas && !car.mistaken_since &&
         !is_out_of_reach(vehicle, tick);
}

void DrivenPlans::driven(VehicleId vehicle, Nanoseconds tick, Nanoseconds follows,
                         Violations& violations) {
  Car& car = cars_[vehicle];
  std::erase_if(car.received, [&](const std::pair<Nanoseconds, Nanoseconds>& command) {
    const auto& [valid_after, create] = command;
    if (valid_after > tick) return false;
    car.newest_valid = std::max(car.newest_valid, create);
    return true;
  });
  const bool changes = follows != car.follows;
  car.follows = follows;
  if (has_newest_plan(car)) car.mistaken_since.reset();
  const bool is_lost = car.mistaken_since && tick / period_ > car.mistaken_since->value;
  if (is_lost || has_dropped_plan(car, tick)) car.out_of_reach_until = tick + kAfterwards;
  judge_order(vehicle, car, tick, violations);
  if (!changes || follows == 0) return;
  const AgreedPlan plan = plan_of(car, follows);
  if (!plan || plan == car.driven) return;
  car.driven = plan;
  judge_pairs(vehicle, tick, violations);
}

void DrivenPlans::judge_order(VehicleId vehicle, Car& car, Nanoseconds tick,
                              Violations& violations) {
  if (car.follows == 0) return;
  if (car.follows >= car.newest_valid || !disobeyed_.insert(vehicle).second) return;
  violations.push_back({.at = tick,
                        .check = "commands",
                        .text = "vehicle " + std::to_string(vehicle.value) +
                                " follows an older command than it has received"});
}

void DrivenPlans::judge_pairs(VehicleId vehicle, Nanoseconds tick, Violations& violations) {
  const Car& car = cars_.at(vehicle);
  if (!is_judged(vehicle, car, tick)) return;
  const OccupiedAreas& areas = *car.driven->areas;
  const StepIndex now{tick / period_};
  for (const auto& [other, its] : cars_) {
    if (other == vehicle || !is_judged(other, its, tick)) continue;
    const StepIndex from = std::max({now, areas.first, its.driven->areas->first});
    if (are_free(areas, *its.driven->areas, from, horizon_steps_) ||
        !met_.insert(std::minmax(vehicle, other)).second) {
      continue;
    }
    violations.push_back({.at = tick,
                          .check = "driven",
                          .text = "vehicles " + std::to_string(other.value) + " and " +
                                  std::to_string(vehicle.value) +
                                  " drive plans that meet from step " + std::to_string(from.value) +
                                  " on"});
  }
}

}  // namespace hlc::closed_loop
