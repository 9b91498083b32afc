#include "planner/maneuver_design/travel_time.hpp"

namespace hlc::maneuver_design {

double TravelTime::value(const vehicle::StateVector& /*x*/, const vehicle::Input& /*u*/) const {
  return 1.0;
}

CostGradient TravelTime::gradient(const vehicle::StateVector& /*x*/,
                                  const vehicle::Input& /*u*/) const {
  return {};
}

}  // namespace hlc::maneuver_design
