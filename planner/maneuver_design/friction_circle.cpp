#include "planner/maneuver_design/friction_circle.hpp"

#include <fmt/format.h>

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
  return fmt::format("friction circle of {:g} m/s^2", acceleration_max_mps2_);
}

}  // namespace hlc::maneuver_design
