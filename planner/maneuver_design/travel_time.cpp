#include "planner/maneuver_design/travel_time.hpp"

namespace hlc {

double TravelTime::value(const StateVector& /*x*/, const Input& /*u*/) const { return 1.0; }

CostGradient TravelTime::gradient(const StateVector& /*x*/, const Input& /*u*/) const { return {}; }

}  // namespace hlc
