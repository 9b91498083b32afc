#include "hlc_bridge/dds/convert_areas.hpp"

#include <algorithm>

#include "hlc_bridge/messages/validate.hpp"

namespace hlc::dds {

PolygonMessage polygon_to_wire(const ConvexPolygon& polygon) {
  PolygonMessage result;
  result.vertices_m().reserve(polygon.vertices_m.size());
  for (const Point& vertex : polygon.vertices_m) {
    PointMessage point;
    point.x_m(vertex.x());
    point.y_m(vertex.y());
    result.vertices_m().push_back(point);
  }
  return result;
}

ConvexPolygon polygon_from_wire(const PolygonMessage& wire) {
  ConvexPolygon result;
  auto& vertices = result.vertices_m;
  vertices.reserve(wire.vertices_m().size());
  for (const PointMessage& point : wire.vertices_m()) {
    const Point vertex{point.x_m(), point.y_m()};
    if (vertices.empty() || vertices.back() != vertex) vertices.push_back(vertex);
  }
  while (vertices.size() > 1 && vertices.back() == vertices.front()) vertices.pop_back();
  return result;
}

bool is_valid(const PolygonMessage& wire) {
  return wire.vertices_m().size() <= kMaxEntries && is_valid_area(polygon_from_wire(wire));
}

std::vector<PolygonMessage> polygons_to_wire(const std::vector<ConvexPolygon>& areas_m) {
  std::vector<PolygonMessage> result;
  for (const ConvexPolygon& area : areas_m) result.push_back(polygon_to_wire(area));
  return result;
}

bool are_valid(const std::vector<PolygonMessage>& wire) {
  return wire.size() <= kMaxEntries &&
         std::ranges::all_of(wire, [](const PolygonMessage& area) { return is_valid(area); });
}

std::vector<ConvexPolygon> polygons_from_wire(const std::vector<PolygonMessage>& wire) {
  std::vector<ConvexPolygon> result;
  for (const PolygonMessage& area : wire) result.push_back(polygon_from_wire(area));
  return result;
}

AreasMessage areas_to_wire(const coordination::OccupiedAreas& areas) {
  const auto& [first, areas_m, final_area_m] = areas;
  AreasMessage result;
  result.first_step(first.value);
  result.areas_m(polygons_to_wire(areas_m));
  result.final_area_m(polygon_to_wire(final_area_m));
  return result;
}

bool is_valid(const AreasMessage& wire) {
  return are_valid(wire.areas_m()) && is_valid(wire.final_area_m());
}

coordination::OccupiedAreas areas_from_wire(const AreasMessage& wire) {
  return {.first = {wire.first_step()},
          .areas_m = polygons_from_wire(wire.areas_m()),
          .final_area_m = polygon_from_wire(wire.final_area_m())};
}

}  // namespace hlc::dds
