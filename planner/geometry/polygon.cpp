#include "planner/geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/common/demand.hpp"
#include "planner/geometry/cross.hpp"

namespace hlc {
namespace {

/// Outward normal of a counter-clockwise polygon's edge with this direction.
Point right_of(const Point& direction) { return {direction.y(), -direction.x()}; }

std::size_t next(std::size_t i, std::size_t size) { return i + 1 == size ? 0 : i + 1; }
std::size_t previous(std::size_t i, std::size_t size) { return i == 0 ? size - 1 : i - 1; }

/// True if `b` protrudes to the right of the line from `a` to `c` by more than the tolerance. It
/// may lie beyond an end where x differs by rounding only.
bool stands_out(const Point& a, const Point& b, const Point& c) {
  const Point along = c - a;
  const double area_m2 = cross(b - a, along);
  if (area_m2 <= 0.0) return false;
  const double beyond = (b - a).dot(along);
  if (beyond < 0.0) return (b - a).norm() > kHullTolerance_m;
  if (beyond > along.squaredNorm()) return (b - c).norm() > kHullTolerance_m;
  return area_m2 > kHullTolerance_m * along.norm();
}

/// The lower half of the hull of points sorted by x; the upper half for points in reverse order.
void append_half_hull(std::span<const Point> sorted_m, std::vector<Point>& hull_m) {
  const std::size_t first = hull_m.size();
  for (const Point& point : sorted_m) {
    while (hull_m.size() >= first + 2 &&
           !stands_out(hull_m[hull_m.size() - 2], hull_m.back(), point)) {
      hull_m.pop_back();
    }
    hull_m.push_back(point);
  }
  hull_m.pop_back();  // the first of the other half
}

/// True if an edge of `a` separates the polygons: no point of `b` lies on its inner side.
template <class Points>
bool has_separating_edge(const ConvexPolygon& a, const Points& b_m) {
  const auto& vertices = a.vertices_m;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point& from = vertices[i];
    const Point edge = vertices[next(i, vertices.size())] - from;
    bool separates = edge != Point::Zero();  // a duplicate corner is no separating edge
    for (const Point& point : b_m) {
      if (cross(edge, point - from) > 0.0) {
        separates = false;
        break;
      }
    }
    if (separates) {
      return true;
    }
  }
  return false;
}

double distance_to_segment_m(const Point& point, const Point& from, const Point& to) {
  const Point edge = to - from;
  const double t = std::clamp((point - from).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return (point - from - t * edge).norm();
}

double distance_from_vertices_m(const ConvexPolygon& a, const ConvexPolygon& b) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Point& point : a.vertices_m) {
    for (std::size_t i = 0; i < b.vertices_m.size(); ++i) {
      const Point& to = b.vertices_m[next(i, b.vertices_m.size())];
      smallest = std::min(smallest, distance_to_segment_m(point, b.vertices_m[i], to));
    }
  }
  return smallest;
}

/// The polygon with every edge moved outwards. Corners whose turn has a cosine below
/// `sharpest_mitre` are cut by one more edge at the same distance, the others mitred.
ConvexPolygon with_edges_moved(const ConvexPolygon& polygon, double distance_m,
                               double sharpest_mitre) {
  // Where the borders with unit normals n1 and n2, moved outwards, meet: at their corner + this.
  const auto corner = [distance_m](const Point& n1, const Point& n2) -> Point {
    return distance_m * (n1 + n2) / std::max(1.0 + n1.dot(n2), 1e-12);
  };
  const auto& vertices = polygon.vertices_m;
  const std::size_t n = vertices.size();
  ConvexPolygon result;
  result.vertices_m.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point in = (vertices[i] - vertices[previous(i, n)]).normalized();
    const Point out = (vertices[next(i, n)] - vertices[i]).normalized();
    if (in.dot(out) >= sharpest_mitre) {
      result.vertices_m.push_back(vertices[i] + corner(right_of(in), right_of(out)));
    } else {
      const Point tip = (in - out).normalized();
      result.vertices_m.push_back(vertices[i] + corner(right_of(in), tip));
      result.vertices_m.push_back(vertices[i] + corner(tip, right_of(out)));
    }
  }
  return result;
}

/// Result of removing the edge from vertex i to i + 1: its neighbours meet in `corner_m`.
struct EdgeRemoval {
  Point corner_m{Point::Zero()};
  double added_area_m2{std::numeric_limits<double>::infinity()};  ///< infinite: they do not meet
};

EdgeRemoval edge_removal(const ConvexPolygon::Vertices& vertices, std::size_t i) {
  const std::size_t n = vertices.size();
  const Point& from = vertices[i];
  const Point& to = vertices[next(i, n)];
  const Point before = from - vertices[previous(i, n)];
  const Point after = vertices[next(next(i, n), n)] - to;
  const double turn = cross(before, after);
  if (turn <= 0.0) {
    return {};  // they turn by pi or more: their extensions do not meet outside this edge
  }
  const double t = cross(to - from, after) / turn;
  const Point corner = from + t * before;
  return {corner, 0.5 * std::abs(cross(corner - from, to - from))};
}

}  // namespace

Box bounding_box(const ConvexPolygon& polygon) {
  Box box;
  for (const Point& vertex : polygon.vertices_m) {
    box.min_m = box.min_m.cwiseMin(vertex);
    box.max_m = box.max_m.cwiseMax(vertex);
  }
  return box;
}

Box bounding_box(const Segment& segment) {
  return {segment.from_m.cwiseMin(segment.to_m), segment.from_m.cwiseMax(segment.to_m)};
}

bool overlap(const Box& a, const Box& b) {
  return a.min_m.x() <= b.max_m.x() && b.min_m.x() <= a.max_m.x() && a.min_m.y() <= b.max_m.y() &&
         b.min_m.y() <= a.max_m.y();
}

std::vector<Point> hull_vertices(std::vector<Point> points_m) {
  std::sort(points_m.begin(), points_m.end(), [](const Point& a, const Point& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  points_m.erase(std::unique(points_m.begin(), points_m.end()), points_m.end());
  if (points_m.size() < 2) {
    return points_m;
  }
  std::vector<Point> hull_m;
  hull_m.reserve(points_m.size() + 1);  // the last of the lower half is the first of the upper
  append_half_hull(points_m, hull_m);
  std::reverse(points_m.begin(), points_m.end());
  append_half_hull(points_m, hull_m);
  return hull_m;
}

ConvexPolygon convex_hull(std::vector<Point> points_m) {
  const std::vector<Point> hull_m = hull_vertices(std::move(points_m));
  if (hull_m.size() < 3) {
    return {};
  }
  return {{hull_m.begin(), hull_m.end()}};
}

ConvexPolygon convex_hull(std::span<const ConvexPolygon> areas) {
  std::size_t num_points = 0;
  for (const ConvexPolygon& area : areas) num_points += area.vertices_m.size();
  std::vector<Point> points;
  points.reserve(num_points);
  for (const ConvexPolygon& area : areas) {
    points.insert(points.end(), area.vertices_m.begin(), area.vertices_m.end());
  }
  return convex_hull(std::move(points));
}

ConvexPolygon around_circle(const Point& middle_m, double radius_m) {
  constexpr double kHalfAngle_rad = std::numbers::pi / double{kCircleCorners};
  ConvexPolygon polygon;
  for (std::size_t i = 0; i < kCircleCorners; ++i) {
    const double angle_rad = 2.0 * kHalfAngle_rad * static_cast<double>(i);
    polygon.vertices_m.emplace_back(middle_m + radius_m / std::cos(kHalfAngle_rad) *
                                                   Point(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return polygon;
}

ConvexPolygon transformed(const ConvexPolygon& polygon, const Pose& frame) {
  const double c = std::cos(frame.heading_rad);
  const double s = std::sin(frame.heading_rad);
  ConvexPolygon result;
  result.vertices_m.reserve(polygon.vertices_m.size());
  for (const Point& vertex : polygon.vertices_m) {
    result.vertices_m.emplace_back(frame.x_m + c * vertex.x() - s * vertex.y(),
                                   frame.y_m + s * vertex.x() + c * vertex.y());
  }
  return result;
}

ConvexPolygon inflated(const ConvexPolygon& polygon, double distance_m) {
  HLC_DEMAND(distance_m >= 0.0, distance_m);
  constexpr double kSharpestMitre = -0.5;  // cosine of the turn: inner angle of 60 degrees
  return with_edges_moved(polygon, distance_m + kRoundingAllowance_m, kSharpestMitre);
}

ConvexPolygon simplified_outwards(const ConvexPolygon& polygon, std::size_t max_vertices) {
  HLC_DEMAND(max_vertices >= 4, max_vertices);
  if (polygon.vertices_m.size() <= max_vertices) {
    return polygon;
  }
  ConvexPolygon::Vertices vertices = polygon.vertices_m;
  // With five or more edges there is always one whose neighbours meet: the sum of the outer angles
  // at its ends is below pi for at least one edge, because all outer angles add up to 2 pi.
  while (vertices.size() > max_vertices) {
    std::size_t best = 0;
    EdgeRemoval least;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const EdgeRemoval removal = edge_removal(vertices, i);
      if (removal.added_area_m2 < least.added_area_m2) {
        best = i;
        least = removal;
      }
    }
    vertices[best] = least.corner_m;
    vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(next(best, vertices.size())));
  }
  constexpr double kMitreAll = -2.0;  // cutting a corner would add a vertex
  return with_edges_moved(ConvexPolygon{std::move(vertices)}, kRoundingAllowance_m, kMitreAll);
}

bool contains(const ConvexPolygon& polygon, const Point& point_m, double tolerance_m) {
  return contains(polygon, ConvexPolygon{{point_m}}, tolerance_m);
}

bool contains(const ConvexPolygon& polygon, const ConvexPolygon& other, double tolerance_m) {
  const auto& vertices = polygon.vertices_m;
  const auto& corners = other.vertices_m;
  if (polygon.empty() || other.empty()) return !polygon.empty();
  std::size_t farthest = 0;  // outside, of the corners
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point& from = vertices[i];
    const Point edge = vertices[next(i, vertices.size())] - from;
    if (i == 0) {
      for (std::size_t k = 1; k < corners.size(); ++k) {
        if (cross(edge, corners[k] - corners[farthest]) < 0.0) farthest = k;
      }
    }
    for (std::size_t tries = 1; tries < corners.size(); ++tries) {
      const std::size_t k = next(farthest, corners.size());
      if (cross(edge, corners[k] - corners[farthest]) >= 0.0) break;
      farthest = k;
    }
    const double inwards = cross(edge, corners[farthest] - from);
    if (inwards < 0.0 && inwards < -tolerance_m * edge.norm()) return false;
  }
  return true;
}

bool intersects(const ConvexPolygon& a, const ConvexPolygon& b) {
  return !a.empty() && !b.empty() && !has_separating_edge(a, b.vertices_m) &&
         !has_separating_edge(b, a.vertices_m);
}

bool intersects(const ConvexPolygon& polygon, const Segment& segment) {
  const Point ends[2] = {segment.from_m, segment.to_m};
  if (polygon.empty() || has_separating_edge(polygon, ends)) {
    return false;
  }
  const Point direction = segment.to_m - segment.from_m;
  if (direction == Point::Zero()) {
    return true;  // a single point, which no edge excludes
  }
  bool some_left = false;
  bool some_right = false;
  for (const Point& vertex : polygon.vertices_m) {
    const double side = cross(direction, vertex - segment.from_m);
    some_left = some_left || side > 0.0;
    some_right = some_right || side < 0.0;
  }
  return some_left && some_right;
}

double distance_m(const ConvexPolygon& a, const ConvexPolygon& b) {
  if (intersects(a, b)) {
    return 0.0;
  }
  return std::min(distance_from_vertices_m(a, b), distance_from_vertices_m(b, a));
}

}  // namespace hlc
