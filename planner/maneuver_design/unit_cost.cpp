#include "planner/maneuver_design/unit_cost.hpp"

namespace hlc::maneuver_design {

std::optional<double> unit_cost(const automaton::Trim& trim, const RunningCost& cost) {
  if (cost.depends_on_pose()) {
    return std::nullopt;
  }
  return cost.value(vehicle::to_vector({Pose{}, trim.speed_mps, trim.steering_rad}),
                    vehicle::Input{});
}

double trim_step_cost(const automaton::Trim& trim, double duration_s, const RunningCost& cost,
                      const vehicle::VehicleParameters& vehicle) {
  if (const std::optional<double> per_second = unit_cost(trim, cost)) {
    return duration_s * *per_second;
  }
  constexpr int kPieces = 64;
  const auto at = [&](double share) {
    const Pose pose = vehicle::trim_motion(Pose{}, trim.speed_mps, trim.steering_rad,
                                           share * duration_s, vehicle);
    return cost.value(vehicle::to_vector({pose, trim.speed_mps, trim.steering_rad}),
                      vehicle::Input{});
  };
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    sum += at(1.0 * i / kPieces) + 4.0 * at((i + 0.5) / kPieces) + at((i + 1.0) / kPieces);
  }
  return sum * duration_s / (6.0 * kPieces);
}

}  // namespace hlc::maneuver_design
