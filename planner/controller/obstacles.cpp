#include "planner/controller/obstacles.hpp"

namespace hlc::controller {

void old_and_new_plans(const CoupledVehicle& other, StepIndex step,
                       std::vector<ConvexPolygon>& areas_m) {
  if (other.is_predecessor && other.prediction == nullptr) {
    areas_m.push_back(other.traffic->reachable_area_m);
  }
  if (other.prediction != nullptr && other.prediction->is_new) {
    areas_m.push_back(other.prediction->areas.during(step));
  }
  areas_m.push_back(other.traffic->running.during(step));
}

void predictions_and_standing_successors(const CoupledVehicle& other, StepIndex step,
                                         std::vector<ConvexPolygon>& areas_m) {
  if (other.prediction != nullptr) {
    areas_m.push_back(other.prediction->areas.during(step));
  } else if (other.is_predecessor) {
    areas_m.push_back(other.traffic->reachable_area_m);
  }
  const coordination::OccupiedAreas& running = other.traffic->running;
  const bool stands = running.areas_m.size() <= 1;  // only the current step
  if (!other.is_predecessor && stands) areas_m.push_back(running.during(step));
}

void old_plans(const CoupledVehicle& other, StepIndex step, std::vector<ConvexPolygon>& areas_m) {
  areas_m.push_back(other.traffic->running.during(step));
}

void no_plans(const CoupledVehicle& /*other*/, StepIndex /*step*/,
              std::vector<ConvexPolygon>& /*areas_m*/) {}

std::vector<std::vector<ConvexPolygon>> obstacles_m(
    std::span<const CoupledVehicle> coupled, CoupledObstacleRule coupled_rule,
    std::span<const MissingVehicle> missing, const coordination::MissingVehicleRules& missing_rules,
    StepIndex now, std::size_t horizon_steps, double step_s) {
  std::vector<std::vector<ConvexPolygon>> obstacles(horizon_steps);
  for (std::size_t j = 1; j <= horizon_steps; ++j) {
    std::vector<ConvexPolygon>& areas = obstacles[j - 1];
    areas.reserve(2 * coupled.size() + missing.size());
    for (const CoupledVehicle& other : coupled) coupled_rule(other, {now.value + j}, areas);
    for (const MissingVehicle& other : missing) {
      areas.push_back(other.stands_for_good
                          ? coordination::standing_area(*other.measured, missing_rules)
                          : coordination::reachable_disc(*other.measured,
                                                         static_cast<double>(j + 1) * step_s,
                                                         missing_rules));
    }
  }
  return obstacles;
}

}  // namespace hlc::controller
