#include "planner/road/commonroad_shapes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "planner/road/lanelet_pieces.hpp"

namespace hlc::road {
namespace {

using tinyxml2::XMLElement;

/// A number within bounds.
double size_of(const CommonRoadDocument& file, const XMLElement& element, const char* child_name) {
  const double value = file.number(element, child_name, "m");
  if (!(value > 0.0 && value <= kLargestShape_m)) {
    file.fail(element, fmt::format("<{}> is {}, must be > 0 and <= {} [m]", child_name, value,
                                   kLargestShape_m));
  }
  return value;
}

Point centre_of(const CommonRoadDocument& file, const XMLElement& shape) {
  const XMLElement* centre = shape.FirstChildElement("center");
  return centre == nullptr ? Point(0.0, 0.0) : point_of(file, *centre);
}

ConvexPolygon rectangle_of(const CommonRoadDocument& file, const XMLElement& shape) {
  const double turned_rad = shape.FirstChildElement("orientation") == nullptr
                                ? 0.0
                                : file.number(shape, "orientation", "rad");
  const Point at_m = centre_of(file, shape);
  return footprint_area({size_of(file, shape, "length"), size_of(file, shape, "width")},
                        {at_m.x(), at_m.y(), turned_rad});
}

std::vector<Point> corners_of(const CommonRoadDocument& file, const XMLElement& shape) {
  std::vector<Point> corners_m;
  CommonRoadDocument::for_each_child(shape, "point", [&](const XMLElement& corner) {
    corners_m.push_back(point_of(file, corner));
  });
  return corners_m;
}

ConvexPolygon hull_of(const CommonRoadDocument& file, const XMLElement& shape) {
  ConvexPolygon hull = convex_hull(corners_of(file, shape));
  if (hull.empty()) file.fail(shape, "<polygon> has no area, must have at least 3 corners");
  return hull;
}

}  // namespace

std::string_view text_of(const CommonRoadDocument& file, const XMLElement& element,
                         const char* child_name) {
  const char* text = file.child(element, child_name).GetText();
  return text == nullptr ? "" : text;
}

Point point_of(const CommonRoadDocument& file, const XMLElement& element) {
  return {file.number(element, "x", "m"), file.number(element, "y", "m")};
}

Pose pose_of(const CommonRoadDocument& file, const XMLElement& state) {
  const Point at_m = point_of(file, file.child(file.child(state, "position"), "point"));
  const double heading_rad = file.number(file.child(state, "orientation"), "exact", "rad");
  return {at_m.x(), at_m.y(), heading_rad};
}

ConvexPolygon shape_of(const CommonRoadDocument& file, const XMLElement& shape) {
  if (std::strcmp(shape.Name(), "rectangle") == 0) return rectangle_of(file, shape);
  if (std::strcmp(shape.Name(), "circle") == 0) {
    return around_circle(centre_of(file, shape), size_of(file, shape, "radius"));
  }
  if (std::strcmp(shape.Name(), "polygon") == 0) return hull_of(file, shape);
  file.fail(shape, fmt::format("<{}> has a <{}>, must be a <rectangle>, <circle> or <polygon>",
                               shape.Parent()->ToElement()->Name(), shape.Name()));
}

ConvexPolygon region_of(const CommonRoadDocument& file, const XMLElement& shape) {
  if (std::strcmp(shape.Name(), "circle") == 0) {
    const double half_angle_rad = std::numbers::pi / double{kCircleCorners};
    return around_circle(centre_of(file, shape),
                         size_of(file, shape, "radius") * std::cos(half_angle_rad));
  }
  ConvexPolygon region = shape_of(file, shape);
  if (std::strcmp(shape.Name(), "polygon") == 0 && !is_convex(corners_of(file, shape))) {
    file.fail(shape, "<polygon> is not convex, must be: several convex ones together are allowed");
  }
  return region;
}

}  // namespace hlc::road
