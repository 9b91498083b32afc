#include "planner/road/lanelet_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "planner/geometry/cross.hpp"

namespace hlc::road {
namespace {

constexpr double kConvexShare = 1e-6;
/// On the border, up to rounding.
constexpr double kOnBorder_m = 1e-9;

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

}  // namespace

bool is_convex(const std::vector<Point>& corners_m) {
  const ConvexPolygon hull = convex_hull(corners_m);
  const double hull_m2 = area_m2(hull.vertices_m);
  return !hull.empty() && hull_m2 - area_m2(corners_m) <= kConvexShare * hull_m2;
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
  std::size_t first = (lanelet.left_m.size() - 1) / 2;
  std::size_t last = first + 1;
  const auto fits = [&](std::size_t from, std::size_t to) {
    const std::vector<Point> corners_m = corners_between(lanelet, from, to);
    return is_convex(corners_m) && convex_hull(corners_m).vertices_m.size() <= most_corners;
  };
  for (bool grows = true; grows;) {
    grows = false;
    if (last + 1 < lanelet.left_m.size() && fits(first, last + 1)) {
      ++last;
      grows = true;
    }
    if (first > 0 && fits(first - 1, last)) {
      --first;
      grows = true;
    }
  }
  return convex_hull(corners_between(lanelet, first, last));
}

}  // namespace hlc::road
