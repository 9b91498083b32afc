#include "planner/road/goal.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "planner/common/demand.hpp"

namespace hlc::road {
namespace {

/// Two pieces of a stretch meet at a joint of the path, up to rounding.
constexpr double kJoint_m = 1e-9;
/// A place is found by projection, which may lie a little before the one where the region begins.
constexpr double kPlace_m = 0.05;

/// The part of the segment from `from_m` to `to_m` that is in the convex area, as shares of its
/// length.
std::optional<std::pair<double, double>> shares_in(const ConvexPolygon& area_m, const Point& from_m,
                                                   const Point& to_m) {
  double begin = 0.0;
  double end = 1.0;
  const auto& corners = area_m.vertices_m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point edge = corners[(i + 1) % corners.size()] - corners[i];
    const Point inwards(-edge.y(), edge.x());
    const double from = inwards.dot(from_m - corners[i]);
    const double to = inwards.dot(to_m - corners[i]);
    if (from < 0.0 && to < 0.0) return std::nullopt;
    if (from < 0.0) begin = std::max(begin, from / (from - to));
    if (to < 0.0) end = std::min(end, from / (from - to));
  }
  if (begin > end) return std::nullopt;
  return std::pair{begin, end};
}

/// The stretches in the area, in the order of driving, from the segment of `start_s_m` on; on a
/// closed path over all segments and the first one again.
std::vector<Stretch> stretches_in(const ReferencePath& path, const ConvexPolygon& area_m,
                                  double start_s_m) {
  const std::vector<double>& joints = path.joints_s_m();
  const std::vector<Point>& points_m = path.points_m();
  const std::size_t num_segments = joints.size() - 1;
  const auto first = static_cast<std::size_t>(
      std::upper_bound(joints.begin() + 1, joints.end() - 1, start_s_m) - joints.begin() - 1);
  const std::size_t last = path.is_closed() ? first + num_segments : num_segments - 1;
  std::vector<Stretch> stretches;
  for (std::size_t k = first; k <= last; ++k) {
    const std::size_t i = k % num_segments;
    const auto shares = shares_in(area_m, points_m[i], points_m[(i + 1) % points_m.size()]);
    if (!shares) continue;
    const double counted_on_m = k < num_segments ? 0.0 : path.length_m();
    const double length_m = joints[i + 1] - joints[i];
    const Stretch piece{joints[i] + shares->first * length_m + counted_on_m,
                        joints[i] + shares->second * length_m + counted_on_m};
    if (!stretches.empty() && piece.from_s_m - stretches.back().to_s_m < kJoint_m) {
      stretches.back().to_s_m = piece.to_s_m;
    } else {
      stretches.push_back(piece);
    }
  }
  return stretches;
}

}  // namespace

std::optional<Stretch> first_stretch_in(const ReferencePath& path, const ConvexPolygon& area_m,
                                        double start_s_m) {
  const double turn_s_m = start_s_m + path.length_m();
  for (Stretch one : stretches_in(path, area_m, start_s_m)) {
    if (one.from_s_m <= start_s_m) continue;
    if (path.is_closed() && one.from_s_m >= turn_s_m) break;
    if (path.is_closed()) one.to_s_m = std::min(one.to_s_m, turn_s_m);
    return one;
  }
  return std::nullopt;
}

ReferencePath path_until(const ReferencePath& path, double end_s_m) {
  HLC_DEMAND(end_s_m > 0.0 && (path.is_closed() || end_s_m <= path.length_m()), end_s_m,
             path.length_m());
  std::vector<Point> points_m;
  const std::size_t num_points = path.points_m().size();
  for (std::size_t k = 0; path.is_closed() || k < num_points; ++k) {
    const std::size_t laps = k / num_points;
    const double s_m =
        path.joints_s_m()[k % num_points] + static_cast<double>(laps) * path.length_m();
    if (s_m > end_s_m - kJoint_m) break;
    points_m.push_back(path.points_m()[k % num_points]);
  }
  points_m.push_back(path.at(end_s_m));
  return {std::move(points_m), false};
}

bool is_at_goal(const ReferencePath& path, const std::optional<Goal>& goal, double s_m,
                const Pose& pose, const Footprint& footprint) {
  if (path.is_closed()) return false;
  if (goal && s_m >= goal->from_s_m - kPlace_m && contains(goal->area_m, pose.position_m())) {
    return true;
  }
  const double end_s_m = path.length_m();
  return s_m >= end_s_m - footprint.length_m &&
         contains(footprint_area(footprint, pose), path.at(end_s_m));
}

}  // namespace hlc::road
