#include "planner/road/map_obstacles.hpp"

#include <fmt/format.h>

#include "planner/common/text_file.hpp"
#include "planner/road/commonroad_shapes.hpp"

namespace hlc::road {
namespace {

using tinyxml2::XMLElement;

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
      if (text_of(file_, element, "role") != "static") refuse(element);
      add(element);
    });
    return obstacles;
  }

 private:
  [[noreturn]] void refuse(const XMLElement& element) const {
    file_.fail(element, fmt::format("<{}> {}: is not regarded, must be absent", element.Name(),
                                    CommonRoadDocument::quoted(file_.attribute(element, "id"))));
  }

  [[nodiscard]] MapObstacle read(const XMLElement& element) const {
    MapObstacle obstacle{.id = file_.id_attribute(element, "id"),
                         .type = std::string(text_of(file_, element, "type")),
                         .areas_m = {}};
    const Pose frame = pose_of(file_, file_.child(element, "initialState"));
    const XMLElement& shapes = file_.child(element, "shape");
    for (const XMLElement* shape = shapes.FirstChildElement(); shape != nullptr;
         shape = shape->NextSiblingElement()) {
      obstacle.areas_m.push_back(transformed(shape_of(file_, *shape), frame));
    }
    if (obstacle.areas_m.empty()) {
      file_.fail(shapes, "<shape> is empty, must have a <rectangle>, <circle> or <polygon>");
    }
    return obstacle;
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
