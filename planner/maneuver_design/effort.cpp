#include "planner/maneuver_design/effort.hpp"

namespace hlc::maneuver_design {

double Effort::value(const vehicle::StateVector& /*x*/, const vehicle::Input& u) const {
  return u.acceleration_mps2 * u.acceleration_mps2 + u.steering_rate_radps * u.steering_rate_radps;
}

CostGradient Effort::gradient(const vehicle::StateVector& /*x*/, const vehicle::Input& u) const {
  CostGradient gradient;
  gradient.input << 2.0 * u.acceleration_mps2, 2.0 * u.steering_rate_radps;
  return gradient;
}

}  // namespace hlc::maneuver_design
