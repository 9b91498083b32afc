#include "planner/road/map_obstacles.hpp"

#include <fmt/format.h>

#include <cstring>
#include <utility>

#include "planner/common/text_file.hpp"
#include "planner/geometry/footprint.hpp"
#include "planner/road/commonroad_document.hpp"

namespace hlc::road {
namespace {

using tinyxml2::XMLElement;

constexpr double kLargest_m = 1000.0;

class ObstacleReader {
 public:
  ObstacleReader(std::string_view xml, const std::string& name) : file_(xml, name) {}

  [[nodiscard]] std::vector<MapObstacle> read() const {
    for (const char* name : {"dynamicObstacle", "environmentObstacle", "phantomObstacle",
                             "trafficSign", "trafficLight"}) {
      if (const XMLElement* element = file_.root().FirstChildElement(name)) refuse(*element);
    }
    std::vector<MapObstacle> obstacles;
    const auto add = [&](const XMLElement& element) { obstacles.push_back(read(element)); };
    CommonRoadDocument::for_each_child(file_.root(), "staticObstacle", add);
    CommonRoadDocument::for_each_child(file_.root(), "obstacle", [&](const XMLElement& element) {
      if (text(element, "role") != "static") refuse(element);
      add(element);
    });
    return obstacles;
  }

 private:
  [[noreturn]] void refuse(const XMLElement& element) const {
    file_.fail(element, fmt::format("<{}> {}: is not regarded, must be absent", element.Name(),
                                    CommonRoadDocument::quoted(file_.attribute(element, "id"))));
  }

  [[nodiscard]] std::string_view text(const XMLElement& element, const char* child_name) const {
    const char* text = file_.child(element, child_name).GetText();
    return text == nullptr ? "" : text;
  }

  /// A number within bounds.
  [[nodiscard]] double size(const XMLElement& element, const char* child_name) const {
    const double value = file_.number(element, child_name, "m");
    if (!(value > 0.0 && value <= kLargest_m)) {
      file_.fail(element, fmt::format("<{}> is {}, must be > 0 and <= {} [m]", child_name, value,
                                      kLargest_m));
    }
    return value;
  }

  [[nodiscard]] Point point(const XMLElement& element) const {
    return {file_.number(element, "x", "m"), file_.number(element, "y", "m")};
  }

  /// The pose of a state whose position and orientation are exact.
  [[nodiscard]] Pose pose(const XMLElement& state) const {
    const Point at_m = point(file_.child(file_.child(state, "position"), "point"));
    const double heading_rad = file_.number(file_.child(state, "orientation"), "exact", "rad");
    return {at_m.x(), at_m.y(), heading_rad};
  }

  /// Where a shape lies in the frame of its obstacle.
  [[nodiscard]] Point centre(const XMLElement& shape) const {
    const XMLElement* centre = shape.FirstChildElement("center");
    return centre == nullptr ? Point(0.0, 0.0) : point(*centre);
  }

  [[nodiscard]] ConvexPolygon rectangle(const XMLElement& shape) const {
    const double turned_rad = shape.FirstChildElement("orientation") == nullptr
                                  ? 0.0
                                  : file_.number(shape, "orientation", "rad");
    const Point at_m = centre(shape);
    return footprint_area({size(shape, "length"), size(shape, "width")},
                          {at_m.x(), at_m.y(), turned_rad});
  }

  [[nodiscard]] ConvexPolygon polygon(const XMLElement& shape) const {
    std::vector<Point> corners_m;
    CommonRoadDocument::for_each_child(
        shape, "point", [&](const XMLElement& corner) { corners_m.push_back(point(corner)); });
    ConvexPolygon hull = convex_hull(std::move(corners_m));
    if (hull.empty()) file_.fail(shape, "<polygon> has no area, must have at least 3 corners");
    return hull;
  }

  [[nodiscard]] MapObstacle read(const XMLElement& element) const {
    MapObstacle obstacle{.id = file_.id_attribute(element, "id"),
                         .type = std::string(text(element, "type")),
                         .areas_m = {}};
    const Pose frame = pose(file_.child(element, "initialState"));
    const XMLElement& shapes = file_.child(element, "shape");
    for (const XMLElement* shape = shapes.FirstChildElement(); shape != nullptr;
         shape = shape->NextSiblingElement()) {
      obstacle.areas_m.push_back(transformed(area(*shape), frame));
    }
    if (obstacle.areas_m.empty()) {
      file_.fail(shapes, "<shape> is empty, must have a <rectangle>, <circle> or <polygon>");
    }
    return obstacle;
  }

  [[nodiscard]] ConvexPolygon area(const XMLElement& shape) const {
    if (std::strcmp(shape.Name(), "rectangle") == 0) return rectangle(shape);
    if (std::strcmp(shape.Name(), "circle") == 0) {
      return around_circle(centre(shape), size(shape, "radius"));
    }
    if (std::strcmp(shape.Name(), "polygon") == 0) return polygon(shape);
    file_.fail(shape, fmt::format("<shape> has a <{}>, must be a <rectangle>, <circle> or "
                                  "<polygon>",
                                  shape.Name()));
  }

  CommonRoadDocument file_;
};

}  // namespace

std::vector<MapObstacle> parse_map_obstacles(std::string_view xml, const std::string& name) {
  return ObstacleReader(xml, name).read();
}

std::vector<MapObstacle> read_map_obstacles(const std::filesystem::path& file) {
  return parse_map_obstacles(read_file(file, kMostInputBytes), file.string());
}

}  // namespace hlc::road
