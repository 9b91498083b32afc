#pragma once

#include <cmath>

#include "planner/geometry/pose.hpp"

namespace hlc::search {

/// A pose whose heading is stored as a direction, so that composing poses needs no trigonometry.
struct Frame {
  Point origin_m{Point::Zero()};
  double cos_heading{1.0};
  double sin_heading{0.0};
};

[[nodiscard]] inline Frame to_frame(const Pose& pose) {
  return {pose.position_m(), std::cos(pose.heading_rad), std::sin(pose.heading_rad)};
}

/// A point given in `frame`, in the parent frame of `frame`.
[[nodiscard]] inline Point transformed(const Point& point_m, const Frame& frame) {
  return {frame.origin_m.x() + frame.cos_heading * point_m.x() - frame.sin_heading * point_m.y(),
          frame.origin_m.y() + frame.sin_heading * point_m.x() + frame.cos_heading * point_m.y()};
}

/// First a, then b in a's frame (the same as for poses).
[[nodiscard]] inline Frame compose(const Frame& a, const Frame& b) {
  return {transformed(b.origin_m, a), a.cos_heading * b.cos_heading - a.sin_heading * b.sin_heading,
          a.sin_heading * b.cos_heading + a.cos_heading * b.sin_heading};
}

}  // namespace hlc::search
