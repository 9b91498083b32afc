#include "planner/geometry/pose.hpp"

#include <cmath>
#include <numbers>

namespace hlc {

Pose compose(const Pose& a, const Pose& b) {
  const Point position_m = transformed(b.position_m(), a);
  return {position_m.x(), position_m.y(), a.heading_rad + b.heading_rad};
}

Pose between(const Pose& a, const Pose& b) {
  const double c = std::cos(a.heading_rad);
  const double s = std::sin(a.heading_rad);
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  return {c * dx + s * dy, -s * dx + c * dy, b.heading_rad - a.heading_rad};
}

Point transformed(const Point& point_m, const Pose& frame) {
  const double c = std::cos(frame.heading_rad);
  const double s = std::sin(frame.heading_rad);
  return {frame.x_m + c * point_m.x() - s * point_m.y(),
          frame.y_m + s * point_m.x() + c * point_m.y()};
}

double wrap_angle(double angle_rad) {
  constexpr double kPi = std::numbers::pi;
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

}  // namespace hlc
