#include "hlc_bridge/messages/validate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/geometry/cross.hpp"

namespace hlc {
namespace {

/// Corners closer than this are one: the direction between them would be rounding.
constexpr double kSameCorner_m = 1e-9;

bool are_near(const ConvexPolygon& area) {
  return std::ranges::all_of(area.vertices_m, [](const Point& corner) {
    return std::abs(corner.x()) <= kLargestCoordinate_m &&
           std::abs(corner.y()) <= kLargestCoordinate_m;
  });
}

ConvexPolygon::Vertices distinct(const ConvexPolygon& area) {
  ConvexPolygon::Vertices corners;
  const auto is_far = [](const Point& a, const Point& b) {
    return (a - b).squaredNorm() > kSameCorner_m * kSameCorner_m;
  };
  for (const Point& corner : area.vertices_m) {
    if (corners.empty() || is_far(corners.back(), corner)) corners.push_back(corner);
  }
  while (corners.size() > 1 && !is_far(corners.front(), corners.back())) corners.pop_back();
  return corners;
}

}  // namespace

bool is_valid_area(const ConvexPolygon& area) {
  if (area.empty()) return true;
  if (!are_near(area)) return false;
  const ConvexPolygon::Vertices corners = distinct(area);
  const std::size_t n = corners.size();
  if (n < 3) return false;
  double turned_rad = 0.0;
  double twice_area_m2 = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point& corner = corners[i];
    const Point before = corner - corners[(i + n - 1) % n];
    const Point after = corners[(i + 1) % n] - corner;
    const double turn = cross(before, after);
    const bool is_straight =
        before.dot(after) > 0.0 && -turn <= kConvexTolerance_m * (before + after).norm();
    if (turn < 0.0 && !is_straight) return false;
    turned_rad += std::atan2(turn, before.dot(after));
    twice_area_m2 += cross(corner - corners[0], after);
  }
  // Left turns only, once around: a star turns left, too, but more than once.
  return twice_area_m2 > 0.0 && turned_rad < 3.0 * std::numbers::pi;
}

}  // namespace hlc
