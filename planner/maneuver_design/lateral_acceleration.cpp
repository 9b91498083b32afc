#include "planner/maneuver_design/lateral_acceleration.hpp"

namespace hlc {

LateralAcceleration lateral_acceleration(const StateVector& x, const VehicleParameters& vehicle) {
  const double v = x(3);
  const StateJacobian jacobian = state_jacobian(x, vehicle);
  const double kappa = jacobian(2, 3);            // psi' = v kappa
  const double yaw_by_steering = jacobian(2, 4);  // v dkappa/ddelta
  return {v * v * kappa, 2.0 * v * kappa, v * yaw_by_steering};
}

}  // namespace hlc
