#include "planner/road/lane_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace hlc::road {
namespace {

constexpr double kSpacing_m = 0.05;
constexpr double kWidth_m = 4.5;  // of the map
constexpr double kHeight_m = 4.0;

Point direction(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }

/// The curve from `from_s_m` to `to_s_m`.
Line sampled(const CurvatureCurve& curve, double from_s_m, double to_s_m) {
  const int intervals = static_cast<int>(std::ceil((to_s_m - from_s_m) / kSpacing_m));
  Line line;
  for (int k = 0; k <= intervals; ++k) {
    line.push_back(curve.at(from_s_m + (to_s_m - from_s_m) * k / intervals));
  }
  return line;
}

bool same(const Point& a, const Point& b) { return (a - b).norm() < 1e-6; }

bool same_line(const std::vector<Point>& a, const std::vector<Point>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

bool same_reversed(const std::vector<Point>& a, const std::vector<Point>& b) {
  return std::equal(a.begin(), a.end(), b.rbegin(), b.rend(), same);
}

}  // namespace

Pose shifted(const Pose& pose, double left_m) {
  const Point along = direction(pose.heading_rad);
  return {.x_m = pose.x_m - left_m * along.y(),
          .y_m = pose.y_m + left_m * along.x(),
          .heading_rad = pose.heading_rad};
}

Pose turned(const Pose& pose) {
  return {.x_m = kWidth_m - pose.x_m,
          .y_m = kHeight_m - pose.y_m,
          .heading_rad = pose.heading_rad + std::numbers::pi};
}

Line turned(Line line) {
  for (Pose& pose : line) pose = turned(pose);
  return line;
}

Line driven_back(Line line) {
  std::reverse(line.begin(), line.end());
  for (Pose& pose : line) pose.heading_rad += std::numbers::pi;
  return line;
}

Line mirrored_x(Line line) {
  std::reverse(line.begin(), line.end());
  for (Pose& pose : line) {
    pose = {.x_m = kWidth_m - pose.x_m, .y_m = pose.y_m, .heading_rad = -pose.heading_rad};
  }
  return line;
}

Line mirrored_y(Line line) { return turned(mirrored_x(std::move(line))); }

Line bent(Line line, const Pose& begin, const Pose& end) {
  const double intervals = static_cast<double>(line.size() - 1);
  const double length = intervals * (line[1].position_m() - line[0].position_m()).norm();
  const auto lack = [&](const Pose& target, const Pose& pose) {
    return std::pair<Point, Point>(
        target.position_m() - pose.position_m(),
        length * (direction(target.heading_rad) - direction(pose.heading_rad)));
  };
  const auto [d0, m0] = lack(begin, line.front());
  const auto [d1, m1] = lack(end, line.back());
  for (std::size_t k = 1; k + 1 < line.size(); ++k) {
    const double t = static_cast<double>(k) / intervals;
    const Point position = line[k].position_m() + (2.0 * t * t * t - 3.0 * t * t + 1.0) * d0 +
                           (t * t * t - 2.0 * t * t + t) * m0 +
                           (3.0 * t * t - 2.0 * t * t * t) * d1 + (t * t * t - t * t) * m1;
    const Point along = direction(line[k].heading_rad) +
                        ((6.0 * t * t - 6.0 * t) * (d0 - d1) + (3.0 * t * t - 4.0 * t + 1.0) * m0 +
                         (3.0 * t * t - 2.0 * t) * m1) /
                            length;
    line[k] = {
        .x_m = position.x(), .y_m = position.y(), .heading_rad = std::atan2(along.y(), along.x())};
  }
  line.front() = begin;
  line.back() = end;
  return line;
}

Line stretch(const CurvatureCurve& curve, double from_s_m, double to_s_m, const Pose& begin,
             const Pose& end) {
  return bent(sampled(curve, from_s_m, to_s_m), begin, end);
}

Lanelet lane_along(const Line& line, LaneletId id, double left_m) {
  Lanelet lanelet;
  lanelet.id = id;
  for (const Pose& pose : line) {
    lanelet.left_m.push_back(shifted(pose, left_m + kLaneWidth_m / 2.0).position_m());
    lanelet.right_m.push_back(shifted(pose, left_m - kLaneWidth_m / 2.0).position_m());
  }
  return lanelet;
}

void link(LaneletMap& map) {
  for (auto& [id, lanelet] : map.lanelets) {
    for (auto& [other_id, other] : map.lanelets) {
      if (same(lanelet.left_m.back(), other.left_m.front()) &&
          same(lanelet.right_m.back(), other.right_m.front())) {
        lanelet.successors.push_back(other_id);
        other.predecessors.push_back(id);
      }
      if (same_line(lanelet.left_m, other.right_m)) {
        lanelet.adjacent_left = {.id = other_id, .same_direction = true};
        other.adjacent_right = {.id = id, .same_direction = true};
      }
      if (id != other_id && same_reversed(lanelet.left_m, other.left_m)) {
        lanelet.adjacent_left = {.id = other_id, .same_direction = false};
      }
    }
  }
}

}  // namespace hlc::road
