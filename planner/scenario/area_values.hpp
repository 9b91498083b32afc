#pragma once

#include "planner/common/node.hpp"
#include "planner/geometry/polygon.hpp"

namespace hlc::scenario {

/// Most corners of a polygon in a file.
inline constexpr std::size_t kMostCorners = 32;
/// Largest coordinate of an area, and largest length, width and radius [m].
inline constexpr double kFarthest_m = 10'000.0;
inline constexpr double kLargestArea_m = 1000.0;
/// Smallest length, width and radius [m].
inline constexpr double kSmallestArea_m = 0.001;

/// A convex area in a file: a map that has exactly one of
///
///     rectangle: {x_m, y_m, heading_rad (default 0), length_m, width_m}   around its middle
///     circle:    {x_m, y_m, radius_m}
///     polygon:   [[x, y], ...]   3 to kMostCorners corners in order, either way round
///
/// A circle is read as the polygon around_circle.
/// @throws std::invalid_argument with one line: bounds, or a polygon that is not convex
[[nodiscard]] ConvexPolygon read_area(const Node& node);

}  // namespace hlc::scenario
