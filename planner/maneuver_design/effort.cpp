#include "planner/maneuver_design/effort.hpp"

namespace hlc {

double Effort::value(const StateVector& /*x*/, const Input& u) const {
  return u.acceleration_mps2 * u.acceleration_mps2 + u.steering_rate_radps * u.steering_rate_radps;
}

CostGradient Effort::gradient(const StateVector& /*x*/, const Input& u) const {
  CostGradient gradient;
  gradient.input << 2.0 * u.acceleration_mps2, 2.0 * u.steering_rate_radps;
  return gradient;
}

}  // namespace hlc
