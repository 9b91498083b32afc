#include "planner/geometry/intersection.hpp"

#include "planner/common/demand.hpp"
#include "planner/geometry/cross.hpp"

namespace hlc {
namespace {

/// The part of the polygon to the left of a line, a point on it included.
ConvexPolygon left_part(const ConvexPolygon& polygon, const Point& on_line_m, const Point& along) {
  ConvexPolygon part;
  const auto& corners = polygon.vertices_m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& from = corners[i];
    const Point& to = corners[(i + 1) % corners.size()];
    const double from_left = cross(along, from - on_line_m);
    const double to_left = cross(along, to - on_line_m);
    if (from_left >= 0.0) part.vertices_m.push_back(from);
    if ((from_left >= 0.0) != (to_left >= 0.0)) {
      part.vertices_m.push_back(from + (to - from) * (from_left / (from_left - to_left)));
    }
  }
  return part;
}

double triangle_area_m2(const ConvexPolygon& polygon, std::size_t i) {
  const auto& corners = polygon.vertices_m;
  return 0.5 * cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
}

}  // namespace

ConvexPolygon intersection(const ConvexPolygon& a, const ConvexPolygon& b) {
  ConvexPolygon shared = a;
  const auto& corners = b.vertices_m;
  if (b.empty()) return {};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    shared = left_part(shared, corners[i], corners[(i + 1) % corners.size()] - corners[i]);
  }
  // What remains of polygons that only touch is a point or a line.
  return area_m2(shared) > 0.0 ? shared : ConvexPolygon{};
}

double area_m2(const ConvexPolygon& polygon) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.vertices_m.size(); ++i) {
    area += triangle_area_m2(polygon, i);
  }
  return area;
}

Point centroid_m(const ConvexPolygon& polygon) {
  const double whole_m2 = area_m2(polygon);
  HLC_DEMAND(whole_m2 > 0.0);
  const auto& corners = polygon.vertices_m;
  Point sum = Point::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += triangle_area_m2(polygon, i) * (corners[i] + corners[i + 1] - 2.0 * corners[0]) / 3.0;
  }
  return corners[0] + sum / whole_m2;
}

}  // namespace hlc
