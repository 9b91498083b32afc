#pragma once

#include <string_view>

#include "planner/geometry/polygon.hpp"
#include "planner/road/commonroad_document.hpp"

/// Shapes, points and poses in a CommonRoad file. All errors are those of its document. Only
/// sources of this folder include this file.
namespace hlc::road {

/// Largest length, width and radius of a shape [m].
inline constexpr double kLargestShape_m = 1000.0;

/// The text of a child, which there must be; empty if it holds none.
[[nodiscard]] std::string_view text_of(const CommonRoadDocument& file,
                                       const tinyxml2::XMLElement& element, const char* child_name);

/// <x> and <y> of an element.
[[nodiscard]] Point point_of(const CommonRoadDocument& file, const tinyxml2::XMLElement& element);

/// Of a state whose position is a point and whose orientation is exact.
[[nodiscard]] Pose pose_of(const CommonRoadDocument& file, const tinyxml2::XMLElement& state);

/// A <rectangle>, <circle> (the polygon around it) or <polygon> (its convex hull) in the frame that
/// its centre is given in.
/// @throws std::runtime_error also for another shape, and a polygon without area
[[nodiscard]] ConvexPolygon shape_of(const CommonRoadDocument& file,
                                     const tinyxml2::XMLElement& shape);

/// The same for a region to be in, of which no part may lie outside of the shape: the polygon
/// within a circle.
/// @throws std::runtime_error also for a polygon that is not convex
[[nodiscard]] ConvexPolygon region_of(const CommonRoadDocument& file,
                                      const tinyxml2::XMLElement& shape);

}  // namespace hlc::road
