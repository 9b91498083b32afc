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

double steady_slip_rad(double curvature_per_m, const IdentifiedVehicle& vehicle) {
  const double delta = std::clamp(steady_steering(curvature_per_m, vehicle),
                                  vehicle.steering_offset - 1.0, vehicle.steering_offset + 1.0);
  return vehicle.slip_gain_rad * delta + vehicle.slip_offset_rad;
}

IdentifiedVehicle kinematic_vehicle(const VehicleParameters& vehicle, double steering_max_rad) {
  IdentifiedVehicle result;
  result.path_speed_gain = 1.0;
  result.path_speed_steering = 0.0;
  result.slip_gain_rad = slip_angle_rad(steering_max_rad, vehicle);
  result.yaw_rate_gain_per_m = curvature_per_m(steering_max_rad, vehicle);
  result.steering_offset = 0.0;
  result.slip_offset_rad = 0.0;
  return result;
}

}  // namespace hlc::vehicle
