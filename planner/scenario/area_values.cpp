#include "planner/scenario/area_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "planner/geometry/footprint.hpp"

namespace hlc::scenario {
namespace {

double read_coordinate(const Node& node, const char* key) {
  return node.required<double>(key, between(-kFarthest_m, kFarthest_m));
}

double read_size(const Node& node, const char* key) {
  return node.required<double>(key, between(kSmallestArea_m, kLargestArea_m));
}

ConvexPolygon read_rectangle(const Node& node) {
  node.check_keys({"x_m", "y_m", "heading_rad", "length_m", "width_m"});
  const Pose middle{
      read_coordinate(node, "x_m"), read_coordinate(node, "y_m"),
      node.optional<double>("heading_rad", 0.0,
                            between(-2.0 * std::numbers::pi, 2.0 * std::numbers::pi))};
  const Footprint size{read_size(node, "length_m"), read_size(node, "width_m")};
  return footprint_area(size, middle);
}

ConvexPolygon read_circle(const Node& node) {
  node.check_keys({"x_m", "y_m", "radius_m"});
  const Point middle_m{read_coordinate(node, "x_m"), read_coordinate(node, "y_m")};
  const double radius_m = read_size(node, "radius_m");
  return around_circle(middle_m, radius_m);
}

/// Whether `corners_m` goes once round the hull, either way.
bool goes_round(std::vector<Point> corners_m, const ConvexPolygon& hull) {
  if (corners_m.size() != hull.vertices_m.size()) return false;
  const auto is_round = [&] {
    const auto begin = std::ranges::find(corners_m, hull.vertices_m.front());
    if (begin == corners_m.end()) return false;
    std::ranges::rotate(corners_m, begin);
    return std::ranges::equal(corners_m, hull.vertices_m);
  };
  if (is_round()) return true;
  std::ranges::reverse(corners_m);
  return is_round();
}

ConvexPolygon read_polygon(const Node& node) {
  const std::vector<Node> corners = node.list("polygon");
  if (corners.size() < 3 || corners.size() > kMostCorners) {
    node.fail("polygon",
              fmt::format("a list of 3 ... {} corners, got {}", kMostCorners, corners.size()));
  }
  std::vector<Point> corners_m;
  for (const Node& corner : corners) {
    const std::vector<Node> values = corner.entries(2, "a corner [x, y] in m");
    const Allowed allowed = between(-kFarthest_m, kFarthest_m);
    corners_m.emplace_back(values[0].as<double>(allowed), values[1].as<double>(allowed));
  }
  ConvexPolygon hull = convex_hull(corners_m);
  if (!goes_round(corners_m, hull)) {
    node.fail("polygon",
              "convex: corners in order round it, each a bend to the same side, none twice");
  }
  return hull;
}

}  // namespace

ConvexPolygon read_area(const Node& node) {
  const bool is_rectangle = node.has("rectangle");
  const bool is_circle = node.has("circle");
  const bool is_polygon = node.has("polygon");
  if (int{is_rectangle} + int{is_circle} + int{is_polygon} != 1) {
    node.fail(is_rectangle ? "rectangle" : "polygon",
              "the only one of rectangle, circle and polygon");
  }
  if (is_rectangle) return read_rectangle(node.map("rectangle"));
  if (is_circle) return read_circle(node.map("circle"));
  return read_polygon(node);
}

}  // namespace hlc::scenario
