#include "planner/vehicle/lateral_acceleration.hpp"

#include <cmath>

namespace hlc::vehicle {

LateralAcceleration lateral_acceleration(const StateVector& x, const VehicleParameters& vehicle) {
  const double v = x(3);
  const StateJacobian jacobian = state_jacobian(x, vehicle);
  const double kappa = jacobian(2, 3);            // psi' = v kappa
  const double yaw_by_steering = jacobian(2, 4);  // v dkappa/ddelta
  return {v * v * kappa, 2.0 * v * kappa, v * yaw_by_steering};
}

bool is_within_friction(const State& state, const Input& input, const VehicleParameters& vehicle,
                        const VehicleLimits& limits) {
  if (!limits.friction_mps2) return true;
  const double lateral_mps2 = lateral_acceleration(to_vector(state), vehicle).value_mps2;
  return std::hypot(input.acceleration_mps2, lateral_mps2) <= *limits.friction_mps2 * (1.0 + 1e-6);
}

}  // namespace hlc::vehicle
