#pragma once

#include <boost/container/small_vector.hpp>
#include <span>
#include <vector>

#include "planner/geometry/pose.hpp"

namespace hlc {

/// A convex polygon: vertices counter-clockwise, no three in a row on a line, not closed (the last
/// vertex is not repeated). At least 3 vertices, or 0: the empty polygon, which holds no point.
struct ConvexPolygon {
  /// The corners of a swept area are stored in the polygon itself: areas are made, copied and
  /// destroyed by the hundred in every step, and heap allocation would dominate their cost.
  using Vertices = boost::container::small_vector<Point, 8>;

  Vertices vertices_m;

  [[nodiscard]] bool empty() const { return vertices_m.empty(); }
  friend bool operator==(const ConvexPolygon&, const ConvexPolygon&) = default;
};

/// A straight piece of a boundary [m].
struct Segment {
  Point from_m{Point::Zero()};
  Point to_m{Point::Zero()};
};

/// An axis-parallel box; the box of the empty polygon is empty (min > max).
struct Box {
  Point min_m{Point::Constant(1e300)};
  Point max_m{Point::Constant(-1e300)};
};

[[nodiscard]] Box bounding_box(const ConvexPolygon& polygon);
[[nodiscard]] Box bounding_box(const Segment& segment);
[[nodiscard]] bool overlap(const Box& a, const Box& b);

/// A hull omits vertices that protrude by less than this from the line of their neighbours, so that
/// no three consecutive vertices are collinear. Far below every relevant length, far above
/// rounding.
inline constexpr double kHullTolerance_m = 1e-12;

/// Added where a polygon must certainly contain another, in spite of rounding.
inline constexpr double kRoundingAllowance_m = 1e-12;

/// The smallest convex polygon that contains all points (monotone chain, O(n log n)), up to
/// kHullTolerance_m. Duplicate and collinear points are accepted; the empty polygon if all points
/// are collinear.
[[nodiscard]] ConvexPolygon convex_hull(std::vector<Point> points_m);

/// The smallest convex polygon that contains all `areas`.
[[nodiscard]] ConvexPolygon convex_hull(std::span<const ConvexPolygon> areas);

/// Vertices of the same hull, counter-clockwise, also if it has no area: both ends of a line, a
/// single point, nothing.
[[nodiscard]] std::vector<Point> hull_vertices(std::vector<Point> points_m);

/// Corners of the polygon that takes the place of a circle.
inline constexpr std::size_t kCircleCorners = 16;
/// The regular polygon of kCircleCorners corners that the circle touches from within: no point of
/// the circle is outside, and no corner farther from it than 2 % of the radius.
[[nodiscard]] ConvexPolygon around_circle(const Point& middle_m, double radius_m);

/// The polygon, given in `frame`, in the frame that `frame` itself is given in.
[[nodiscard]] ConvexPolygon transformed(const ConvexPolygon& polygon, const Pose& frame);

/// A polygon that contains every point within `distance_m` of `polygon`: each edge moved outwards
/// by that distance (and kRoundingAllowance_m), corners mitred (so it is larger than the rounded
/// Minkowski sum at the corners). Corners sharper than 60 degrees are cut at that distance by one
/// more edge. The empty polygon stays empty. @pre distance_m >= 0
[[nodiscard]] ConvexPolygon inflated(const ConvexPolygon& polygon, double distance_m);

/// A polygon with at most `max_vertices` vertices that contains `polygon`, made by removing edges
/// and extending their neighbours, the one that adds least area first (greedy). A polygon that is
/// small enough is returned unchanged; otherwise every remaining edge lies on an edge of `polygon`,
/// up to kRoundingAllowance_m outside. @pre max_vertices >= 4
[[nodiscard]] ConvexPolygon simplified_outwards(const ConvexPolygon& polygon,
                                                std::size_t max_vertices);

/// True if the point lies in the polygon or at most `tolerance_m` outside of its border.
[[nodiscard]] bool contains(const ConvexPolygon& polygon, const Point& point_m,
                            double tolerance_m = 0.0);
/// True if that holds for all corners of `other`, O(m + n): from edge to edge of `polygon` the
/// corner farthest outside moves monotonically. @pre no two consecutive corners are equal
[[nodiscard]] bool contains(const ConvexPolygon& polygon, const ConvexPolygon& other,
                            double tolerance_m = 0.0);

/// Separating axis test: true if the two share a point that is inside at least one of them
/// (polygons that only touch do not intersect; the empty polygon intersects nothing; duplicate
/// corners are accepted, if not all are equal). Does not allocate; compares no boxes, since
/// frequent callers keep them and call `overlap` first.
[[nodiscard]] bool intersects(const ConvexPolygon& a, const ConvexPolygon& b);
[[nodiscard]] bool intersects(const ConvexPolygon& polygon, const Segment& segment);

/// Smallest distance between two polygons [m]; 0 if they intersect; infinite if one is empty.
[[nodiscard]] double distance_m(const ConvexPolygon& a, const ConvexPolygon& b);

}  // namespace hlc
