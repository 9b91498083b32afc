#include "planner/maneuver_design/friction_circle.hpp"

#include <sstream>

#include "planner/vehicle/lateral_acceleration.hpp"

namespace hlc::maneuver_design {

double FrictionCircle::value(const vehicle::StateVector& x, const vehicle::Input& u) const {
  const double longitudinal = u.acceleration_mps2 / acceleration_max_mps2_;
  const double lateral =
      vehicle::lateral_acceleration(x, vehicle_).value_mps2 / acceleration_max_mps2_;
  return longitudinal * longitudinal + lateral * lateral - 1.0;
}

CostGradient FrictionCircle::gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const {
  const vehicle::LateralAcceleration lateral = vehicle::lateral_acceleration(x, vehicle_);
  const double factor = 2.0 / (acceleration_max_mps2_ * acceleration_max_mps2_);
  CostGradient gradient;
  gradient.state(3) = factor * lateral.value_mps2 * lateral.by_speed;
  gradient.state(4) = factor * lateral.value_mps2 * lateral.by_steering;
  gradient.input.x() = factor * u.acceleration_mps2;
  return gradient;
}

std::string FrictionCircle::name() const {
  std::ostringstream text;
  text << "friction circle of " << acceleration_max_mps2_ << " m/s^2";
  return text.str();
}

}  // namespace hlc::maneuver_design
