#pragma once

#include "planner/geometry/pose.hpp"

namespace hlc {

/// a_x b_y - a_y b_x: twice the signed area of the triangle (0, a, b), positive if b lies to the
/// left of a.
[[nodiscard]] inline double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace hlc
