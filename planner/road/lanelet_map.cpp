#include "planner/road/lanelet_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/common/text_file.hpp"
#include "planner/road/commonroad_document.hpp"
#include "planner/road/commonroad_writer.hpp"

namespace hlc::road {
namespace {

using tinyxml2::XMLElement;

/// Reads the lanelets of one document.
class LaneletReader {
 public:
  LaneletReader(std::string_view xml, const std::string& name) : file_(xml, name) {}

  [[nodiscard]] LaneletMap read() const {
    const XMLElement& root = file_.root();
    LaneletMap map{.benchmark_id = std::string(file_.attribute(root, "benchmarkID")),
                   .lanelets = {}};
    CommonRoadDocument::for_each_child(root, "lanelet", [&](const XMLElement& element) {
      Lanelet lanelet = read_lanelet(element);
      const LaneletId id = lanelet.id;
      if (!map.lanelets.emplace(id, std::move(lanelet)).second) {
        file_.fail(element, fmt::format("lanelet id {} is taken already", id));
      }
    });
    if (map.lanelets.empty()) file_.fail(root, "no <lanelet>, at least one is needed");
    check_references(map);
    return map;
  }

 private:
  [[nodiscard]] std::vector<Point> bound(const XMLElement& lanelet, const char* bound_name) const {
    const XMLElement& element = file_.child(lanelet, bound_name);
    std::vector<Point> points;
    CommonRoadDocument::for_each_child(element, "point", [&](const XMLElement& point) {
      points.emplace_back(file_.number(point, "x", "m"), file_.number(point, "y", "m"));
    });
    if (points.size() < 2) {
      file_.fail(element,
                 fmt::format("<{}> has {} points, must be at least 2", bound_name, points.size()));
    }
    return points;
  }

  [[nodiscard]] std::vector<LaneletId> references(const XMLElement& lanelet,
                                                  const char* reference_name) const {
    std::vector<LaneletId> ids;
    CommonRoadDocument::for_each_child(lanelet, reference_name, [&](const XMLElement& reference) {
      ids.push_back(file_.id_attribute(reference, "ref"));
    });
    return ids;
  }

  [[nodiscard]] std::optional<Lanelet::Adjacent> adjacent(const XMLElement& lanelet,
                                                          const char* side) const {
    const XMLElement* element = lanelet.FirstChildElement(side);
    if (element == nullptr) return std::nullopt;
    const std::string_view direction = file_.attribute(*element, "drivingDir");
    if (direction != "same" && direction != "opposite") {
      file_.fail(*element, fmt::format("<{}> drivingDir is {}, must be \"same\" or \"opposite\"",
                                       side, CommonRoadDocument::quoted(direction)));
    }
    return Lanelet::Adjacent{.id = file_.id_attribute(*element, "ref"),
                             .same_direction = direction == "same"};
  }

  [[nodiscard]] Lanelet read_lanelet(const XMLElement& element) const {
    Lanelet lanelet;
    lanelet.id = file_.id_attribute(element, "id");
    lanelet.left_m = bound(element, "leftBound");
    lanelet.right_m = bound(element, "rightBound");
    if (lanelet.left_m.size() != lanelet.right_m.size()) {
      file_.fail(element,
                 fmt::format("lanelet {}: <leftBound> has {} points and <rightBound> {}, must be "
                             "equal",
                             lanelet.id, lanelet.left_m.size(), lanelet.right_m.size()));
    }
    lanelet.predecessors = references(element, "predecessor");
    lanelet.successors = references(element, "successor");
    lanelet.adjacent_left = adjacent(element, "adjacentLeft");
    lanelet.adjacent_right = adjacent(element, "adjacentRight");
    return lanelet;
  }

  void check_references(const LaneletMap& map) const {
    const auto check = [&](const XMLElement& reference) {
      const LaneletId id = file_.id_attribute(reference, "ref");
      if (map.lanelets.contains(id)) return;
      file_.fail(reference, fmt::format("<{}> ref is {}, must be the id of a lanelet of this file",
                                        reference.Name(), id));
    };
    CommonRoadDocument::for_each_child(file_.root(), "lanelet", [&](const XMLElement& lanelet) {
      for (const char* kind : {"predecessor", "successor", "adjacentLeft", "adjacentRight"}) {
        CommonRoadDocument::for_each_child(lanelet, kind, check);
      }
    });
  }

  CommonRoadDocument file_;
};

}  // namespace

double narrowest_lane_m(const LaneletMap& map) {
  double narrowest_m = std::numeric_limits<double>::infinity();
  for (const auto& [id, lanelet] : map.lanelets) {
    for (std::size_t i = 0; i < lanelet.left_m.size(); ++i) {
      narrowest_m = std::min(narrowest_m, (lanelet.left_m[i] - lanelet.right_m[i]).norm());
    }
  }
  return narrowest_m;
}

LaneletMap scaled(LaneletMap map, double factor) {
  HLC_DEMAND(factor > 0.0, factor);
  for (auto& [id, lanelet] : map.lanelets) {
    for (std::vector<Point>* bound : {&lanelet.left_m, &lanelet.right_m}) {
      for (Point& point : *bound) point *= factor;
    }
  }
  return map;
}

Box ground_m(const LaneletMap& map) {
  constexpr double kBesideLanes_m = 0.03;
  Box box;
  for (const auto& [id, lanelet] : map.lanelets) {
    for (const auto* bound : {&lanelet.left_m, &lanelet.right_m}) {
      for (const Point& point : *bound) {
        box.min_m = box.min_m.cwiseMin(point);
        box.max_m = box.max_m.cwiseMax(point);
      }
    }
  }
  box.min_m.array() -= kBesideLanes_m;
  box.max_m.array() += kBesideLanes_m;
  return box;
}

std::vector<Point> centre_line_m(const Lanelet& lanelet) {
  std::vector<Point> points_m;
  points_m.reserve(lanelet.left_m.size());
  for (std::size_t i = 0; i < lanelet.left_m.size(); ++i) {
    points_m.emplace_back((lanelet.left_m[i] + lanelet.right_m[i]) / 2.0);
  }
  return points_m;
}

LaneletMap parse_lanelet_map(std::string_view xml, const std::string& name) {
  return LaneletReader(xml, name).read();
}

LaneletMap read_lanelet_map(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    throw std::runtime_error(file.string() +
                             ": cannot be read, must be a CommonRoad file (2020a or 2018b)");
  }
  return parse_lanelet_map(read_file(file, kMostInputBytes), file.string());
}

std::string to_commonroad_xml(const LaneletMap& map) {
  CommonRoadWriter writer({.benchmark_id = map.benchmark_id,
                           .author = "generate_map",
                           .source = "generated",
                           .time_step = "0.2"});
  writer.add_lanelets(map);
  return writer.finish();
}

void write_lanelet_map(const LaneletMap& map, const std::filesystem::path& file) {
  write_file(file, to_commonroad_xml(map));
}

}  // namespace hlc::road
