#pragma once

#include <vector>

#include "planner/geometry/polygon.hpp"
#include "planner/road/lanelet_map.hpp"

/// The area of a lanelet, piece by piece.
namespace hlc::road {

/// Whether corners in order, either way round, are those of a convex polygon: their hull is larger
/// by at most a millionth of its area.
[[nodiscard]] bool is_convex(const std::vector<Point>& corners_m);

/// Whether a point lies in the lanelet or on its border.
[[nodiscard]] bool contains(const Lanelet& lanelet, const Point& point_m);

/// A convex part of the lanelet around its middle: as many of its pieces, each between two points
/// of the same index of both bounds, as are convex together and have at most `most_corners`
/// corners; or, if that is larger, as in a bend, a rectangle of at least half the lane's width that
/// lies between the bounds. Empty if the middle piece is neither.
[[nodiscard]] ConvexPolygon convex_part_of(const Lanelet& lanelet, std::size_t most_corners);

}  // namespace hlc::road
