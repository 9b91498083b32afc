#include "planner/maneuver_design/distance.hpp"

namespace hlc {

double Distance::value(const StateVector& x, const Input& /*u*/) const {
  return -x.head<2>().squaredNorm();
}

CostGradient Distance::gradient(const StateVector& x, const Input& /*u*/) const {
  CostGradient gradient;
  gradient.state.head<2>() = -2.0 * x.head<2>();
  return gradient;
}

}  // namespace hlc
