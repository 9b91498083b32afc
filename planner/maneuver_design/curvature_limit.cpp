#include "planner/maneuver_design/curvature_limit.hpp"

#include <fmt/format.h>

#include "planner/vehicle/path_curvature.hpp"

namespace hlc::maneuver_design {

double CurvatureLimit::value(const vehicle::StateVector& x, const vehicle::Input& u) const {
  return factor() * vehicle::course_rate(x, u, vehicle_).value_radps -
         vehicle::turning_speed(x(3)).value_mps;
}

CostGradient CurvatureLimit::gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const {
  const vehicle::CourseRate rate = vehicle::course_rate(x, u, vehicle_);
  CostGradient gradient;
  gradient.state(3) = factor() * rate.by_speed - vehicle::turning_speed(x(3)).by_speed;
  gradient.state(4) = factor() * rate.by_steering;
  gradient.input.y() = factor() * rate.by_steering_rate;
  return gradient;
}

std::string CurvatureLimit::name() const {
  return fmt::format("curvature of {:g} 1/m to the {}", curvature_max_per_m_,
                     side_ == Side::kLeft ? "left" : "right");
}

}  // namespace hlc::maneuver_design
