#include "vehicle_sim/closed_loop/driven_plans.hpp"

#include <algorithm>
#include <string>

#include "planner/controller/command_time.hpp"
#include "planner/coordination/commit.hpp"
#include "vehicle_sim/closed_loop/invariants.hpp"

namespace hlc::closed_loop {
namespace {

/// Commands to be kept after those that may still be followed, copies included.
constexpr std::size_t kKeptMore = 6;
/// More than the pause between a command and its copy, or two copies.
constexpr Nanoseconds kCopyPause = 10 * kNanosecondsPerMillisecond;
/// By then a controller has seen what its vehicle does after a late change.
constexpr std::size_t kStepsToShow = 2;

}  // namespace

DrivenPlans::DrivenPlans(std::size_t horizon_steps, Nanoseconds period,
                         const StandingAreas* standing)
    : horizon_steps_(horizon_steps),
      period_(period),
      num_copies_(controller::num_copies(horizon_steps, 1e-9 * static_cast<double>(period))),
      standing_(standing) {}

void DrivenPlans::commanded(const TrajectoryCommand& command, Nanoseconds at,
                            Violations& violations) {
  if (command.points.empty()) return;  // it changes nothing (command_of)
  Car& car = cars_[{command.vehicle_id}];
  const Nanoseconds usable_until = command.valid_after_stamp + kCommandLifetime;
  if (!car.sent.empty() && car.sent.back().create == command.create_stamp) {  // a copy
    car.sent.back().usable_until = usable_until;
    ++car.sent.back().copies;
    return;
  }
  if (!car.is_seen && off_command_.insert({command.vehicle_id}).second) {
    violations.push_back({.at = at,
                          .check = "commands",
                          .text = "vehicle " + std::to_string(command.vehicle_id) +
                                  " is sent a command, and its controller does not see it"});
  }
  car.sent.push_back(
      {.create = command.create_stamp, .at = at, .usable_until = usable_until, .plan = nullptr});
  const double step_s = 1e-9 * static_cast<double>(period_);
  if (car.sent.size() > controller::drivable_steps(horizon_steps_, step_s) + kKeptMore)
    car.sent.pop_front();
}

bool DrivenPlans::has_newest_plan(const Car& car) {
  const AgreedPlan newest = plan_of(car, car.received.newest());
  return car.num_agreed == 0 || (newest && newest->number == car.agreed->number);
}

void DrivenPlans::published(const coordination::Traffic& traffic, bool is_seen) {
  Car& car = cars_[traffic.vehicle];
  car.announced = traffic.running;
  if (traffic.step.value * period_ > car.late_change.at) ++car.late_change.steps_begun;
  car.is_seen = is_seen;
  if (has_newest_plan(car) || !is_seen) return;
  car.is_mistaken = true;
  if (traffic.step.value >= car.missed_since.value + 2) {
    car.out_of_reach_until = traffic.step.value * period_ + afterwards();
  }
}

/// Where a vehicle stands after its plan, unless its controller is mistaken or does not know
/// either.
void DrivenPlans::note_standing(Car& car, const coordination::Report& report) {
  car.stands.reset();
  if (!car.driven || !car.driven->areas || !car.announced) return;
  const coordination::OccupiedAreas& areas = *car.driven->areas;
  const bool has_run_out = report.step.value >= areas.first.value + areas.areas_m.size();
  const bool stands = car.announced->first == report.step && car.announced->areas_m.empty();
  if (has_run_out && stands && has_newest_plan(car) &&
      report.reason != coordination::FallbackReason::kDeviation) {
    car.stands = car.announced;
  }
}

void DrivenPlans::reported(const coordination::Report& report, const coordination::Plan* in_force) {
  Car& car = cars_[report.vehicle];
  note_standing(car, report);
  if (report.status == coordination::StepStatus::kPlanned) {
    if (has_newest_plan(car)) car.missed_since = report.step;
    Agreed agreed{.number = ++car.num_agreed,
                  .begin = (report.step.value + 1) * period_,
                  .end = in_force->end(),
                  .last_pose = in_force->pose_at(in_force->end()),
                  .areas = std::nullopt};
    if (car.predicted && car.predicted->step == report.step) agreed.areas = car.predicted->areas;
    car.agreed = std::make_shared<const Agreed>(std::move(agreed));
  } else if (in_force != nullptr) {
    car.agreed = kept_plan(car, report, *in_force);
  }
  if (report.reason == coordination::FallbackReason::kDeviation ||
      (report.status == coordination::StepStatus::kStandby && in_force != nullptr)) {
    car.is_mistaken = false;
  }
  note_observation(car, report);
  for (Sent& sent : car.sent) {
    if (!sent.plan) sent.plan = car.agreed;
  }
}

/// What the controller sees after the vehicle has changed over late.
void DrivenPlans::note_observation(Car& car, const coordination::Report& report) const {
  const Nanoseconds at = report.step.value * period_;
  if (car.late_change.at == 0 || at <= car.late_change.at) return;
  if (++car.late_change.steps_ended <= kStepsToShow &&
      report.reason == coordination::FallbackReason::kDeviation) {
    car.out_of_reach_until = at + afterwards();
  }
}

bool DrivenPlans::is_unseen_after_change(const Car& car, Nanoseconds tick) const {
  const LateChange& change = car.late_change;
  if (change.at == 0 || tick >= change.at + afterwards()) return false;
  const bool is_overdue =
      change.steps_begun < kStepsToShow && tick > change.at + kStepsToShow * period_;
  return change.steps_ended == 0 || is_overdue;
}

/// The plan in force where nothing new has been agreed: the same as before, an older one that the
/// vehicle was seen on, or one that has been anchored where it stands. The last one needs no
/// command: what is received already counts as received.
DrivenPlans::AgreedPlan DrivenPlans::kept_plan(const Car& car, const coordination::Report& report,
                                               const coordination::Plan& in_force) {
  const Pose& last_pose = in_force.pose_at(in_force.end());
  const auto is_same = [&](const AgreedPlan& plan) {
    return plan && plan->end == in_force.end() && plan->last_pose == last_pose;
  };
  if (is_same(car.agreed)) return car.agreed;
  const auto found = std::ranges::find_if(car.sent, is_same, &Sent::plan);
  if (found != car.sent.end()) return found->plan;
  const AgreedPlan received = plan_of(car, car.received.newest());
  Agreed anchored{.number = received ? received->number : car.num_agreed,
                  .end = in_force.end(),
                  .last_pose = last_pose,
                  .areas = std::nullopt,
                  .is_anchored = true};
  if (report.status != coordination::StepStatus::kStandby)
    anchored.areas = in_force.areas_from(report.step);
  return std::make_shared<const Agreed>(std::move(anchored));
}

void DrivenPlans::received(const TrajectoryCommand& command) {
  Car& car = cars_[{command.vehicle_id}];
  car.received.add(command);
}

void DrivenPlans::died(VehicleId vehicle, Nanoseconds at) {
  Car& car = cars_[vehicle];
  car.out_of_reach_until = at + afterwards();
  car.driven = nullptr;
  car.follows = 0;
  car.received.drop_waiting();
}

DrivenPlans::AgreedPlan DrivenPlans::plan_of(const Car& car, Nanoseconds create) {
  const auto found = std::ranges::find(car.sent, create, &Sent::create);
  return found == car.sent.end() ? nullptr : found->plan;
}

bool DrivenPlans::has_dropped_plan(const Car& car, Nanoseconds tick) const {
  const AgreedPlan newest = plan_of(car, car.received.newest());
  if (car.follows != 0 || !newest || !newest->areas) return false;
  const bool has_run_out =
      tick / period_ >= newest->areas->first.value + newest->areas->areas_m.size();
  return !has_run_out && tick >= car.received.usable_until();
}

bool DrivenPlans::has_all_that_was_sent(const Car& car) const {
  const Sent& newest = car.sent.back();
  const bool was_stopped_before_copy =
      newest.copies < num_copies_ && car.controller_stopped >= newest.at &&
      car.controller_stopped <= newest.at + num_copies_ * kCopyPause;
  return newest.create == car.received.newest() &&
         newest.usable_until <= car.received.usable_until() && !was_stopped_before_copy;
}

void DrivenPlans::check_drop(VehicleId vehicle, Car& car, Nanoseconds tick,
                             Violations& violations) {
  if (!has_dropped_plan(car, tick)) return;
  if (!has_all_that_was_sent(car)) {
    car.out_of_reach_until = tick + afterwards();
  } else if (!is_out_of_reach(vehicle, tick) && off_command_.insert(vehicle).second) {
    violations.push_back({.at = tick,
                          .check = "commands",
                          .text = "vehicle " + std::to_string(vehicle.value) +
                                  " drops its plan, and its controller has sent nothing more"});
  }
}

bool DrivenPlans::is_out_of_reach(VehicleId vehicle, Nanoseconds at) const {
  const auto car = cars_.find(vehicle);
  return car != cars_.end() && at < car->second.out_of_reach_until;
}

bool DrivenPlans::is_checked(VehicleId vehicle, const Car& car, Nanoseconds tick) const {
  return car.follows != 0 && car.driven && car.driven->areas && !car.is_mistaken &&
         !is_out_of_reach(vehicle, tick);
}

void DrivenPlans::driven(VehicleId vehicle, Nanoseconds tick, Nanoseconds follows,
                         Violations& violations) {
  Car& car = cars_[vehicle];
  car.received.take_valid(tick);
  const bool changes = follows != car.follows;
  car.follows = follows;
  if (has_newest_plan(car)) car.is_mistaken = false;
  const bool is_lost = car.is_mistaken && tick / period_ >= car.missed_since.value + 2;
  if (is_lost) car.out_of_reach_until = tick + afterwards();
  if (is_unseen_after_change(car, tick)) {
    car.out_of_reach_until = std::max(car.out_of_reach_until, tick + kVehiclePeriod);
  }
  check_drop(vehicle, car, tick, violations);
  check_order(vehicle, car, tick, violations);
  if (!changes || follows == 0) return;
  const AgreedPlan plan = plan_of(car, follows);
  if (!plan || plan == car.driven) return;
  if (is_change_late(car, plan, tick)) car.late_change = {.at = tick};
  car.driven = plan;
  car.stands.reset();
  check_pairs(vehicle, tick, violations);
}

/// The plan, or one between the driven one and it, was commanded before it began; the vehicle has
/// not received it until after that.
bool DrivenPlans::is_change_late(const Car& car, const AgreedPlan& plan, Nanoseconds tick) {
  if (!car.driven || plan->is_anchored) return false;
  return std::ranges::any_of(car.sent, [&](const Sent& sent) {
    if (!sent.plan || sent.plan->is_anchored) return false;
    const bool is_between =
        car.driven->number < sent.plan->number && sent.plan->number < plan->number;
    return (sent.plan == plan || is_between) && sent.at < sent.plan->begin &&
           tick >= sent.plan->begin + kVehiclePeriod;
  });
}

void DrivenPlans::check_order(VehicleId vehicle, Car& car, Nanoseconds tick,
                              Violations& violations) {
  if (car.follows == 0) return;
  if (car.follows >= car.received.newest() || !off_command_.insert(vehicle).second) return;
  violations.push_back({.at = tick,
                        .check = "commands",
                        .text = "vehicle " + std::to_string(vehicle.value) +
                                " follows an older command than it has received"});
}

const coordination::OccupiedAreas& DrivenPlans::areas_of(const Car& car) {
  return car.stands ? *car.stands : *car.driven->areas;
}

bool DrivenPlans::meet(const coordination::OccupiedAreas& areas, VehicleId other, const Car& its,
                       StepIndex from) const {
  const coordination::OccupiedAreas& its_areas = areas_of(its);
  if (coordination::are_free(areas, its_areas, from, horizon_steps_)) return false;
  const bool has_run_out = from.value > its_areas.first.value + its_areas.areas_m.size();
  return !has_run_out || standing_ == nullptr || !standing_->has(other) ||
         !coordination::are_free(areas, standing_->area(other), from, horizon_steps_);
}

void DrivenPlans::check_pairs(VehicleId vehicle, Nanoseconds tick, Violations& violations) {
  const Car& car = cars_.at(vehicle);
  if (!is_checked(vehicle, car, tick) || car.driven->is_anchored) return;
  const coordination::OccupiedAreas& areas = *car.driven->areas;
  const StepIndex now{tick / period_};
  for (const auto& [other, its] : cars_) {
    if (other == vehicle || !is_checked(other, its, tick)) continue;
    const StepIndex from = std::max({now, areas.first, areas_of(its).first});
    if (!meet(areas, other, its, from) || !met_.insert(std::minmax(vehicle, other)).second)
      continue;
    violations.push_back({.at = tick,
                          .check = "driven",
                          .text = "vehicles " + std::to_string(other.value) + " and " +
                                  std::to_string(vehicle.value) +
                                  " drive plans that meet from step " + std::to_string(from.value) +
                                  " on"});
  }
}

}  // namespace hlc::closed_loop
