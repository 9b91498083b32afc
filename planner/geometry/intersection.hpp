#pragma once

#include "planner/geometry/polygon.hpp"

namespace hlc {

/// The points that both polygons contain (Sutherland-Hodgman, O(m n)); empty if they share no area.
[[nodiscard]] ConvexPolygon intersection(const ConvexPolygon& a, const ConvexPolygon& b);

/// [m^2]; 0 for the empty polygon.
[[nodiscard]] double area_m2(const ConvexPolygon& polygon);

/// Centre of the polygon's area, a point inside. @pre its area is not 0
[[nodiscard]] Point centroid_m(const ConvexPolygon& polygon);

}  // namespace hlc
