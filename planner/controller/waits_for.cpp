#include "planner/controller/waits_for.hpp"

#include <algorithm>
#include <utility>

namespace hlc::controller {
namespace {

bool may_be_because_of_others(const coordination::Report& report) {
  using enum coordination::FallbackReason;
  switch (report.status) {
    case coordination::StepStatus::kPlanned:
      return true;
    case coordination::StepStatus::kFallback:
      return report.reason == kInfeasible || report.reason == kMissing ||
             report.reason == kConflict || report.reason == kNeighbour;
    case coordination::StepStatus::kStandby:
    case coordination::StepStatus::kMinimalRiskStop:
      break;
  }
  return false;
}

}  // namespace

bool stays_at(const coordination::Plan& plan, const Pose& pose, StepIndex first, StepIndex last) {
  for (StepIndex step = first; step <= last; ++step.value) {
    if (plan.pose_at(step) != pose) return false;
  }
  return true;
}

std::vector<VehicleId> waits_for(const EndedStep& step) {
  const StepIndex now = step.report.step;
  const StepIndex next = step.next();
  const StepIndex end{next.value + step.horizon_steps};
  if (step.is_disturbed || !may_be_because_of_others(step.report)) return {};
  if (!stays_at(step.in_force, step.in_force.pose_at(now), now, end)) return {};
  const std::optional<MotionAlone> alone = step.alone();
  if (!alone || stays_at(alone->plan, alone->plan.pose_at(next), next, end)) return {};

  std::vector<std::pair<StepIndex, VehicleId>> stopping;
  for (const OtherVehicle& other : step.others()) {
    if (const auto first = stops_in(other, alone->areas, step)) {
      stopping.emplace_back(*first, other.vehicle);
    }
  }
  std::ranges::sort(stopping);
  std::vector<VehicleId> vehicles;
  for (const auto& [first, vehicle] : stopping) vehicles.push_back(vehicle);
  return vehicles;
}

}  // namespace hlc::controller
