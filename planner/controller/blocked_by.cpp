#include "planner/controller/blocked_by.hpp"

#include <algorithm>

namespace hlc::controller {
namespace {

template <class IsOne>
std::vector<VehicleId> others_that(const EndedStep& step, IsOne is_one) {
  std::vector<VehicleId> vehicles;
  for (const OtherVehicle& other : step.others()) {
    if (is_one(other)) vehicles.push_back(other.vehicle);
  }
  std::ranges::sort(vehicles);
  return vehicles;
}

std::vector<VehicleId> in_conflict(const EndedStep& step) {
  return others_that(step, [&step](const OtherVehicle& other) {
    return other.compared && other.compared->predicted != nullptr &&
           !are_free(*step.new_plan, *other.compared->predicted, step.next(), step.horizon_steps);
  });
}

std::vector<VehicleId> not_received(const EndedStep& step) {
  return others_that(step, [&step](const OtherVehicle& other) {
    if (step.new_plan == nullptr) return other.is_out_of_contact;
    return other.compared && other.compared->predicted == nullptr &&
           !are_free(*step.new_plan, *other.compared->reachable_area_m, step.next(),
                     step.horizon_steps);
  });
}

std::vector<VehicleId> in_the_way(const EndedStep& step) {
  const std::optional<MotionAlone> alone = step.alone();
  if (!alone) return {};
  return others_that(step, [&](const OtherVehicle& other) {
    return stops_in(other, alone->areas, step).has_value();
  });
}

}  // namespace

std::vector<VehicleId> blocked_by(const EndedStep& step) {
  switch (step.report.reason) {
    case coordination::FallbackReason::kConflict:
      return step.new_plan != nullptr ? in_conflict(step) : in_the_way(step);
    case coordination::FallbackReason::kMissing:
      return not_received(step);
    case coordination::FallbackReason::kNeighbour:
      return others_that(step, [](const OtherVehicle& other) { return other.is_opposed; });
    case coordination::FallbackReason::kInfeasible:
      return in_the_way(step);
    default:
      return {};
  }
}

}  // namespace hlc::controller
