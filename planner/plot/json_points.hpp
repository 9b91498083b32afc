#pragma once

#include <nlohmann/json.hpp>

#include "planner/geometry/pose.hpp"

namespace hlc::plot {

/// [[x, y], ...]
template <class Points>
[[nodiscard]] nlohmann::ordered_json json_points(const Points& points_m) {
  auto points = nlohmann::ordered_json::array();
  for (const Point& point : points_m) points.push_back({point.x(), point.y()});
  return points;
}

/// [x, y, heading]
[[nodiscard]] inline nlohmann::ordered_json json_pose(const Pose& pose) {
  return {pose.x_m, pose.y_m, pose.heading_rad};
}

}  // namespace hlc::plot
