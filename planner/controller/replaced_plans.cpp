#include "planner/controller/replaced_plans.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/geometry/footprint.hpp"
#include "planner/vehicle/delayed_inputs.hpp"

namespace hlc::controller {
namespace {

/// Braking distance of a µCar per speed.
constexpr double kBraking_s = 0.25;
/// A vehicle that brakes stands below this speed: it rolls on by less than the rounding of an area.
constexpr double kStands_mps = 1e-4;
constexpr int kMostTicks = 2000;  // 40 s

Pose braked(const Pose& pose, double speed_mps) {
  const double distance_m = kBraking_s * speed_mps;
  return {.x_m = pose.x_m + distance_m * std::cos(pose.heading_rad),
          .y_m = pose.y_m + distance_m * std::sin(pose.heading_rad),
          .heading_rad = pose.heading_rad};
}

/// Poses of a vehicle that drops its command now, one per tick until it stands.
std::vector<Pose> stopping(const Pose& pose, double speed_mps, double steering_rad,
                           const automaton::UniversalAutomaton& automaton) {
  if (!automaton.identified.steering_rate_per_s) return {braked(pose, speed_mps)};
  const vehicle::IdentifiedVehicle& identified = automaton.identified;
  vehicle::DelayedInputs inputs(
      {.steering = vehicle::steady_servo(vehicle::curvature_per_m(steering_rad, automaton.vehicle),
                                         identified)});
  vehicle::VehicleMotion motion{.pose = pose, .speed_mps = speed_mps};
  const auto stands = [&] {
    return std::abs(motion.speed_mps) < kStands_mps &&
           std::ranges::all_of(inputs.under_way(), [](const vehicle::ActuatorInput& input) {
             return std::abs(input.throttle) < kStands_mps;
           });
  };
  std::vector<Pose> poses;
  for (int tick = 0; tick < kMostTicks && !(tick > 0 && stands()); ++tick) {
    const vehicle::ActuatorInput acting =
        inputs.give(vehicle::stop_input(motion.speed_mps), identified);
    motion = vehicle::stepped(motion, acting, identified);
    poses.push_back(motion.pose);
  }
  return poses;
}

void add_stopping(const Pose& pose, double speed_mps, double steering_rad,
                  const automaton::UniversalAutomaton& automaton,
                  std::vector<ConvexPolygon>& areas) {
  const vehicle::VehicleParameters& vehicle = automaton.vehicle;
  for (const Pose& at : stopping(pose, speed_mps, steering_rad, automaton)) {
    areas.push_back(footprint_area(vehicle.footprint, at, vehicle.safety_margin_m));
  }
}

}  // namespace

ConvexPolygon braking_area(const Pose& pose, double speed_mps, double steering_rad,
                           const automaton::UniversalAutomaton& automaton) {
  const vehicle::VehicleParameters& vehicle = automaton.vehicle;
  std::vector<ConvexPolygon> areas{
      footprint_area(vehicle.footprint, pose, vehicle.safety_margin_m)};
  add_stopping(pose, speed_mps, steering_rad, automaton, areas);
  return convex_hull(areas);
}

ConvexPolygon driven_or_braked_area(const coordination::Plan& plan,
                                    const coordination::OccupiedAreas& announced, StepIndex step,
                                    const automaton::UniversalAutomaton& automaton) {
  const ConvexPolygon& driven = announced.during(step);
  if (step >= plan.end()) return driven;
  std::vector<ConvexPolygon> areas{driven};
  for (const StepIndex at : {step, StepIndex{step.value + 1}}) {
    const vehicle::State state = plan.state_at(at, 0.0, automaton.vehicle);
    add_stopping(state.pose, state.speed_mps, state.steering_rad, automaton, areas);
  }
  return convex_hull(areas);
}

void ReplacedPlans::add(coordination::Plan plan, coordination::OccupiedAreas announced,
                        StepIndex in) {
  formers_.push_back(std::make_shared<const Former>(std::move(plan), std::move(announced), in));
}

void ReplacedPlans::forget(StepIndex now) {
  std::erase_if(formers_, [&](const std::shared_ptr<const Former>& former) {
    return now.value >= former->replaced_in.value + drivable_steps_;
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
