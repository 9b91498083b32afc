#include "vehicle_sim/closed_loop/announced_check.hpp"

#include <cmath>
#include <utility>

namespace hlc::closed_loop {

void AnnouncedCheck::published(const coordination::Traffic& traffic, bool is_seen) {
  Car& car = cars_[traffic.vehicle];
  if (car.is_exempt && !is_seen) return;
  car.is_exempt = false;
  car.running = traffic.running;
  car.agreed.reset();
}

void AnnouncedCheck::reported(const coordination::Report& report, Nanoseconds at) {
  Car& car = cars_[report.vehicle];
  if (report.status != coordination::StepStatus::kPlanned) {
    car.predicted.reset();
    return;
  }
  car.last_plan = at;
  if (car.predicted && car.predicted->step == report.step) adopt(car);
  car.predicted.reset();
}

/// The plan that has been predicted last may be driven.
void AnnouncedCheck::adopt(Car& car) {
  car.before = car.agreed ? std::move(car.agreed) : car.running;
  car.agreed = std::move(car.predicted->areas);
  car.predicted.reset();
}

bool AnnouncedCheck::is_inside(const Car& car, StepIndex step, const Pose& pose) const {
  constexpr double kRounding_m = 1e-4;
  const ConvexPolygon area = footprint_area(footprint_, pose);
  if (step < car.running->first)
    return true;  // replaced by a later plan: the area is no longer known
  for (const auto* announced : {&car.agreed, &car.running, &car.before}) {
    if (*announced && (*announced)->first <= step &&
        contains((*announced)->during(step), area, kRounding_m)) {
      return true;
    }
  }
  return false;
}

void AnnouncedCheck::check_area(VehicleId vehicle, Car& car, Nanoseconds tick, const Pose& pose,
                                Violations& violations) const {
  if (is_inside(car, {tick / period_}, pose)) {
    car.outside_since.reset();
  } else if (!car.outside_since) {
    car.outside_since = tick;
  } else if (!car.is_reported && tick > *car.outside_since + kPatience) {
    car.is_reported = true;
    violations.push_back({.at = tick,
                          .check = "announced",
                          .text = "vehicle " + std::to_string(vehicle.value) +
                                  " is outside all that was announced of it, for 0.5 s"});
  }
}

void AnnouncedCheck::driven(VehicleId vehicle, Nanoseconds tick, const Pose& pose, double speed_mps,
                            Violations& violations) {
  const auto found = cars_.find(vehicle);
  if (found == cars_.end()) return;
  Car& car = found->second;
  if (!car.running && !car.is_exempt) return;  // before the first plan
  if (car.running) check_area(vehicle, car, tick, pose, violations);
  if (!car.runs_on && std::abs(speed_mps) > kMoving_mps && tick > car.last_plan + plan_lasts()) {
    car.runs_on = true;
    violations.push_back(
        {.at = tick,
         .check = "stands",
         .text = "vehicle " + std::to_string(vehicle.value) + " moves long after its last plan"});
  }
}

}  // namespace hlc::closed_loop
