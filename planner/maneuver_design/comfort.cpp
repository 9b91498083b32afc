#include "planner/maneuver_design/comfort.hpp"

#include "planner/vehicle/lateral_acceleration.hpp"

namespace hlc::maneuver_design {

double Comfort::value(const vehicle::StateVector& x, const vehicle::Input& u) const {
  const double lateral = vehicle::lateral_acceleration(x, vehicle_).value_mps2;
  return weights_.longitudinal * u.acceleration_mps2 * u.acceleration_mps2 +
         weights_.lateral * lateral * lateral +
         weights_.steering_rate * u.steering_rate_radps * u.steering_rate_radps;
}

CostGradient Comfort::gradient(const vehicle::StateVector& x, const vehicle::Input& u) const {
  const vehicle::LateralAcceleration lateral = vehicle::lateral_acceleration(x, vehicle_);
  const double slope = 2.0 * weights_.lateral * lateral.value_mps2;
  CostGradient gradient;
  gradient.state(3) = slope * lateral.by_speed;
  gradient.state(4) = slope * lateral.by_steering;
  gradient.input << 2.0 * weights_.longitudinal * u.acceleration_mps2,
      2.0 * weights_.steering_rate * u.steering_rate_radps;
  return gradient;
}

}  // namespace hlc::maneuver_design
