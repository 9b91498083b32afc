#include "planner/vehicle/identified_vehicle.hpp"

#include <algorithm>
#include <cmath>

namespace hlc::vehicle {

// curvature p1 p2 delta^2 - p4 delta + curvature p1 = 0. The root nearest to 0 is written without
// cancellation (and without a special case for curvature 0).
double steady_steering(double curvature_per_m, const IdentifiedVehicle& vehicle) {
  const double c = curvature_per_m * vehicle.path_speed_gain;
  const double b = vehicle.yaw_rate_gain_per_m;
  const double discriminant = b * b - 4.0 * c * c * vehicle.path_speed_steering;
  return 2.0 * c / (b + std::sqrt(std::max(0.0, discriminant)));
}

double steady_servo(double curvature_per_m, const IdentifiedVehicle& vehicle) {
  return steady_steering(curvature_per_m, vehicle) - vehicle.steering_offset;
}

double steady_slip_rad(double curvature_per_m, const IdentifiedVehicle& vehicle) {
  const double delta = std::clamp(steady_steering(curvature_per_m, vehicle),
                                  vehicle.steering_offset - 1.0, vehicle.steering_offset + 1.0);
  return vehicle.slip_gain_rad * delta + vehicle.slip_offset_rad;
}

IdentifiedVehicle kinematic_vehicle(const VehicleParameters& vehicle, const VehicleLimits& limits) {
  return {.path_speed_gain = 1.0,
          .path_speed_steering = 0.0,
          .slip_gain_rad = slip_angle_rad(limits.steering_max_rad, vehicle),
          .yaw_rate_gain_per_m = curvature_per_m(limits.steering_max_rad, vehicle),
          .drag_per_s = 0.0,
          .thrust_offset_mps2 = limits.acceleration_mps2,
          .thrust_per_volt = 0.0,
          .throttle_exponent = 1.0,
          .steering_offset = 0.0,
          .slip_offset_rad = 0.0,
          .steering_rate_per_s = limits.steering_rate_radps / limits.steering_max_rad};
}

}  // namespace hlc::vehicle
