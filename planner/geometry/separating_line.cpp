#include "planner/geometry/separating_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hlc {
namespace {

/// The largest n . p over all corners.
double farthest_m(const ConvexPolygon& polygon, const Point& n) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Point& corner : polygon.vertices_m) farthest = std::max(farthest, n.dot(corner));
  return farthest;
}

/// The best direction so far.
struct Widest {
  double gap_m{-std::numeric_limits<double>::infinity()};
  Point n{Point::Zero()};

  void consider(double gap, const Point& normal) {
    if (gap <= gap_m) return;
    gap_m = gap;
    n = normal;
  }
  [[nodiscard]] bool is_wide() const { return gap_m >= kWideGap_m; }
};

/// Calls `look(corner, outward normal)` for every edge until it returns true.
template <class Look>
void for_edges(const ConvexPolygon& polygon, Look look) {
  const auto& corners = polygon.vertices_m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point edge = corners[(i + 1) % corners.size()] - corners[i];
    const double length_m = edge.norm();
    if (length_m > 0.0 && look(corners[i], Point{edge.y() / length_m, -edge.x() / length_m}))
      return;
  }
}

}  // namespace

std::optional<SeparatingLine> separating_line(const ConvexPolygon& behind,
                                              const ConvexPolygon& beyond, double tolerance_m) {
  if (behind.empty() || beyond.empty()) return std::nullopt;
  Widest widest;
  for_edges(behind, [&](const Point& corner, const Point& n) {
    widest.consider(-farthest_m(beyond, -n) - n.dot(corner), n);
    return widest.is_wide();
  });
  if (!widest.is_wide()) {
    for_edges(beyond, [&](const Point& corner, const Point& n) {
      widest.consider(-n.dot(corner) - farthest_m(behind, -n), -n);
      return widest.is_wide();
    });
  }
  if (widest.gap_m < -tolerance_m) return std::nullopt;
  const double direction_rad = std::atan2(widest.n.y(), widest.n.x());
  return SeparatingLine{
      .direction_rad = direction_rad,
      .offset_m = farthest_m(behind, {std::cos(direction_rad), std::sin(direction_rad)})};
}

}  // namespace hlc
