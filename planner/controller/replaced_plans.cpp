#include "planner/controller/replaced_plans.hpp"

#include <cmath>
#include <utility>

#include "planner/geometry/footprint.hpp"

namespace hlc::controller {
namespace {

/// Braking distance per speed.
constexpr double kBraking_s = 0.25;

Pose braked(const Pose& pose, double speed_mps) {
  const double distance_m = kBraking_s * speed_mps;
  return {.x_m = pose.x_m + distance_m * std::cos(pose.heading_rad),
          .y_m = pose.y_m + distance_m * std::sin(pose.heading_rad),
          .heading_rad = pose.heading_rad};
}

}  // namespace

ConvexPolygon braking_area(const Pose& pose, double speed_mps,
                           const vehicle::VehicleParameters& vehicle) {
  const auto area_at = [&vehicle](const Pose& where) {
    return footprint_area(vehicle.footprint, where, vehicle.safety_margin_m);
  };
  return convex_hull(std::vector{area_at(pose), area_at(braked(pose, speed_mps))});
}

ConvexPolygon driven_or_braked_area(const coordination::Plan& plan,
                                    const coordination::OccupiedAreas& announced, StepIndex step,
                                    const vehicle::VehicleParameters& vehicle) {
  const ConvexPolygon& driven = announced.during(step);
  if (step >= plan.end()) return driven;
  std::vector<ConvexPolygon> areas{driven};
  for (const StepIndex at : {step, StepIndex{step.value + 1}}) {
    const vehicle::State state = plan.state_at(at, 0.0, vehicle);
    areas.push_back(footprint_area(vehicle.footprint, braked(state.pose, state.speed_mps),
                                   vehicle.safety_margin_m));
  }
  return convex_hull(areas);
}

void ReplacedPlans::add(coordination::Plan plan, coordination::OccupiedAreas announced,
                        StepIndex in) {
  formers_.push_back(std::make_shared<const Former>(std::move(plan), std::move(announced), in));
}

void ReplacedPlans::forget(StepIndex now, std::uint64_t drivable_steps) {
  std::erase_if(formers_, [&](const std::shared_ptr<const Former>& former) {
    return now.value >= former->replaced_in.value + drivable_steps;
  });
}

std::vector<const ReplacedPlans::Former*> ReplacedPlans::doubtful() const {
  std::vector<const Former*> result;
  for (const std::shared_ptr<const Former>& former : formers_) {
    if (doubted_until_ && former->replaced_in <= *doubted_until_) result.push_back(former.get());
  }
  return result;
}

}  // namespace hlc::controller
