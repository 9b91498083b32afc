#include "planner/maneuver_design/stopping_distance.hpp"

namespace hlc::maneuver_design {

double StoppingDistance::value(const vehicle::StateVector& x, const vehicle::Input& /*u*/) const {
  return x.head<2>().squaredNorm();
}

CostGradient StoppingDistance::gradient(const vehicle::StateVector& x,
                                        const vehicle::Input& /*u*/) const {
  CostGradient gradient;
  gradient.state.head<2>() = 2.0 * x.head<2>();
  return gradient;
}

}  // namespace hlc::maneuver_design
