#include "planner/maneuver_design/energy.hpp"

#include <algorithm>

namespace hlc {

double Energy::value(const StateVector& x, const Input& u) const {
  return std::max(u.acceleration_mps2, 0.0) * x(3);
}

CostGradient Energy::gradient(const StateVector& x, const Input& u) const {
  CostGradient gradient;
  if (u.acceleration_mps2 > 0.0) {
    gradient.state(3) = u.acceleration_mps2;
    gradient.input.x() = x(3);
  }
  return gradient;
}

}  // namespace hlc
