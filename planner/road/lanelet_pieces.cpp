#include "planner/road/lanelet_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/geometry/cross.hpp"

namespace hlc::road {
namespace {

constexpr double kConvexShare = 1e-6;
/// On the border, up to rounding.
constexpr double kOnBorder_m = 1e-9;
constexpr double kMostTurned_rad = 0.5;

/// Of a polygon by its corners in order.
template <class Corners>
double area_m2(const Corners& corners_m) {
  double twice_m2 = 0.0;
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    twice_m2 +=
        cross(corners_m[i] - corners_m[0], corners_m[(i + 1) % corners_m.size()] - corners_m[0]);
  }
  return std::abs(twice_m2) / 2.0;
}

/// From one pair of points of the bounds to a later one.
std::vector<Point> corners_between(const Lanelet& lanelet, std::size_t first, std::size_t last) {
  std::vector<Point> corners_m;
  for (std::size_t i = first; i <= last; ++i) corners_m.push_back(lanelet.right_m[i]);
  for (std::size_t i = last + 1; i > first; --i) corners_m.push_back(lanelet.left_m[i - 1]);
  return corners_m;
}

/// Pieces `first` to `last` of a lanelet, which may have a convex part.
struct Pieces {
  std::size_t first{};  ///< index of a pair of points of the bounds
  std::size_t last{};   ///< likewise, > first
};

/// As many pieces as `part_of` gives a part for, beginning with the middle one.
template <class PartOf>
ConvexPolygon largest_part(const Lanelet& lanelet, PartOf part_of) {
  Pieces pieces{.first = (lanelet.left_m.size() - 1) / 2, .last = 0};
  pieces.last = pieces.first + 1;
  ConvexPolygon part = part_of(pieces);
  const auto try_pieces = [&](const Pieces& larger) {
    ConvexPolygon found = part_of(larger);
    if (found.empty()) return false;
    part = std::move(found);
    pieces = larger;
    return true;
  };
  for (bool grows = true; grows;) {
    grows = pieces.last + 1 < lanelet.left_m.size() && try_pieces({pieces.first, pieces.last + 1});
    grows |= pieces.first > 0 && try_pieces({pieces.first - 1, pieces.last});
  }
  return part;
}

/// The rectangle along the line through the middles of the first and the last pair of points that
/// lies between all points of the bounds and between both pairs; empty where it is narrower than
/// half the lane there, or the lane turns by more than kMostTurned_rad.
ConvexPolygon rectangle_in(const Lanelet& lanelet, const Pieces& pieces) {
  const Point begin_m = (lanelet.left_m[pieces.first] + lanelet.right_m[pieces.first]) / 2.0;
  const Point end_m = (lanelet.left_m[pieces.last] + lanelet.right_m[pieces.last]) / 2.0;
  const double length_m = (end_m - begin_m).norm();
  if (!(length_m > kOnBorder_m) || !std::isfinite(length_m)) return {};
  const Point along = (end_m - begin_m) / length_m;
  double right_m = -std::numeric_limits<double>::infinity();
  double left_m = std::numeric_limits<double>::infinity();
  double width_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = pieces.first; i <= pieces.last; ++i) {
    const Point across_m = lanelet.left_m[i] - lanelet.right_m[i];
    if (std::abs(along.dot(across_m)) > std::sin(kMostTurned_rad) * across_m.norm()) return {};
    right_m = std::max(right_m, cross(along, lanelet.right_m[i] - begin_m));
    left_m = std::min(left_m, cross(along, lanelet.left_m[i] - begin_m));
    width_m = std::min(width_m, across_m.norm());
  }
  const auto ahead_m = [&](const Point& point_m) { return along.dot(point_m - begin_m); };
  const double from_m =
      std::max(ahead_m(lanelet.left_m[pieces.first]), ahead_m(lanelet.right_m[pieces.first]));
  const double to_m =
      std::min(ahead_m(lanelet.left_m[pieces.last]), ahead_m(lanelet.right_m[pieces.last]));
  if (to_m <= from_m || left_m - right_m < width_m / 2.0) return {};
  const Pose frame{begin_m.x(), begin_m.y(), std::atan2(along.y(), along.x())};
  return transformed(
      convex_hull({{from_m, right_m}, {to_m, right_m}, {to_m, left_m}, {from_m, left_m}}), frame);
}

}  // namespace

bool is_convex(const std::vector<Point>& corners_m) {
  const ConvexPolygon hull = convex_hull(corners_m);
  const double hull_m2 = area_m2(hull.vertices_m);
  return !hull.empty() && std::abs(hull_m2 - area_m2(corners_m)) <= kConvexShare * hull_m2;
}

bool contains(const Lanelet& lanelet, const Point& point_m) {
  for (std::size_t i = 0; i + 1 < lanelet.left_m.size(); ++i) {
    if (contains(convex_hull(corners_between(lanelet, i, i + 1)), point_m, kOnBorder_m)) {
      return true;
    }
  }
  return false;
}

ConvexPolygon convex_part_of(const Lanelet& lanelet, std::size_t most_corners) {
  const ConvexPolygon whole_width = largest_part(lanelet, [&](const Pieces& pieces) {
    const std::vector<Point> corners_m = corners_between(lanelet, pieces.first, pieces.last);
    ConvexPolygon hull = convex_hull(corners_m);
    const bool is_part = is_convex(corners_m) && hull.vertices_m.size() <= most_corners;
    return is_part ? hull : ConvexPolygon{};
  });
  const ConvexPolygon rectangle =
      largest_part(lanelet, [&](const Pieces& pieces) { return rectangle_in(lanelet, pieces); });
  return area_m2(rectangle.vertices_m) > area_m2(whole_width.vertices_m) ? rectangle : whole_width;
}

}  // namespace hlc::road
