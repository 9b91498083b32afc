#include "planner/road/lanelet_map.hpp"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "planner/common/text_file.hpp"
#include "planner/road/commonroad_writer.hpp"

namespace hlc::road {
namespace {

using tinyxml2::XMLElement;

/// Reads one document; its error messages begin with the document's name.
class Reader {
 public:
  explicit Reader(const std::string& name) : name_(name) {}

  LaneletMap read(std::string_view xml) const {
    tinyxml2::XMLDocument document;
    if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
      fail(document.ErrorLineNum(), fmt::format("not well-formed XML ({})", document.ErrorName()));
    }
    const XMLElement* root = document.RootElement();
    if (root == nullptr || std::strcmp(root->Name(), "commonRoad") != 0) {
      fail(root == nullptr ? 1 : root->GetLineNum(), "root element must be <commonRoad>");
    }
    const std::string_view version = attribute(*root, "commonRoadVersion");
    if (version != "2020a") {
      fail(root->GetLineNum(),
           fmt::format("commonRoadVersion is {}, must be \"2020a\"", quoted(version)));
    }
    LaneletMap map{.benchmark_id = std::string(attribute(*root, "benchmarkID")), .lanelets = {}};
    for (const XMLElement* element = root->FirstChildElement("lanelet"); element != nullptr;
         element = element->NextSiblingElement("lanelet")) {
      Lanelet lanelet = read_lanelet(*element);
      const LaneletId id = lanelet.id;
      if (!map.lanelets.emplace(id, std::move(lanelet)).second) {
        fail(element->GetLineNum(), fmt::format("lanelet id {} is taken already", id));
      }
    }
    if (map.lanelets.empty()) {
      fail(root->GetLineNum(), "no <lanelet>, at least one is needed");
    }
    check_references(*root, map);
    return map;
  }

 private:
  [[noreturn]] void fail(int line, const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", name_, line, what));
  }

  /// The value in quotes, without line breaks and cut, so that an error stays one line.
  static std::string quoted(std::string_view value) {
    constexpr std::size_t kMaxLength = 40;
    std::string text(value.substr(0, kMaxLength));
    for (char& c : text) {
      c = c < ' ' ? ' ' : c;
    }
    return '"' + text + (value.size() > kMaxLength ? "...\"" : "\"");
  }

  std::string_view attribute(const XMLElement& element, const char* attribute_name) const {
    const char* value = element.Attribute(attribute_name);
    if (value == nullptr) {
      fail(element.GetLineNum(),
           fmt::format("<{}> needs the attribute {}", element.Name(), attribute_name));
    }
    return value;
  }

  LaneletId id_attribute(const XMLElement& element, const char* attribute_name) const {
    const std::string_view text = attribute(element, attribute_name);
    LaneletId id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (error != std::errc{} || end != text.data() + text.size() || id < 1) {
      fail(element.GetLineNum(),
           fmt::format("<{}> {} is {}, must be a whole number from 1 to 2147483647", element.Name(),
                       attribute_name, quoted(text)));
    }
    return id;
  }

  const XMLElement& child(const XMLElement& element, const char* child_name) const {
    const XMLElement* found = element.FirstChildElement(child_name);
    if (found == nullptr) {
      fail(element.GetLineNum(), fmt::format("<{}> needs a <{}>", element.Name(), child_name));
    }
    return *found;
  }

  double coordinate(const XMLElement& point, const char* axis) const {
    const XMLElement& element = child(point, axis);
    std::string_view text = element.GetText() == nullptr ? "" : element.GetText();
    constexpr const char* kBlank = " \t\r\n";
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    text = text.substr(0, text.find_last_not_of(kBlank) + 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
      fail(element.GetLineNum(),
           fmt::format("<{}> is {}, must be a finite number [m]", axis, quoted(text)));
    }
    return value;
  }

  std::vector<Point> bound(const XMLElement& lanelet, const char* bound_name) const {
    const XMLElement& element = child(lanelet, bound_name);
    std::vector<Point> points;
    for (const XMLElement* point = element.FirstChildElement("point"); point != nullptr;
         point = point->NextSiblingElement("point")) {
      points.emplace_back(coordinate(*point, "x"), coordinate(*point, "y"));
    }
    if (points.size() < 2) {
      fail(element.GetLineNum(),
           fmt::format("<{}> has {} points, must be at least 2", bound_name, points.size()));
    }
    return points;
  }

  std::vector<LaneletId> references(const XMLElement& lanelet, const char* reference_name) const {
    std::vector<LaneletId> ids;
    for (const XMLElement* reference = lanelet.FirstChildElement(reference_name);
         reference != nullptr; reference = reference->NextSiblingElement(reference_name)) {
      ids.push_back(id_attribute(*reference, "ref"));
    }
    return ids;
  }

  std::optional<Lanelet::Adjacent> adjacent(const XMLElement& lanelet, const char* side) const {
    const XMLElement* element = lanelet.FirstChildElement(side);
    if (element == nullptr) {
      return std::nullopt;
    }
    const std::string_view direction = attribute(*element, "drivingDir");
    if (direction != "same" && direction != "opposite") {
      fail(element->GetLineNum(),
           fmt::format("<{}> drivingDir is {}, must be \"same\" or \"opposite\"", side,
                       quoted(direction)));
    }
    return Lanelet::Adjacent{.id = id_attribute(*element, "ref"),
                             .same_direction = direction == "same"};
  }

  Lanelet read_lanelet(const XMLElement& element) const {
    Lanelet lanelet;
    lanelet.id = id_attribute(element, "id");
    lanelet.left_m = bound(element, "leftBound");
    lanelet.right_m = bound(element, "rightBound");
    if (lanelet.left_m.size() != lanelet.right_m.size()) {
      fail(element.GetLineNum(),
           fmt::format("lanelet {}: <leftBound> has {} points and <rightBound> {}, must be equal",
                       lanelet.id, lanelet.left_m.size(), lanelet.right_m.size()));
    }
    lanelet.predecessors = references(element, "predecessor");
    lanelet.successors = references(element, "successor");
    lanelet.adjacent_left = adjacent(element, "adjacentLeft");
    lanelet.adjacent_right = adjacent(element, "adjacentRight");
    return lanelet;
  }

  void check_references(const XMLElement& root, const LaneletMap& map) const {
    for (const XMLElement* lanelet = root.FirstChildElement("lanelet"); lanelet != nullptr;
         lanelet = lanelet->NextSiblingElement("lanelet")) {
      for (const char* kind : {"predecessor", "successor", "adjacentLeft", "adjacentRight"}) {
        for (const XMLElement* element = lanelet->FirstChildElement(kind); element != nullptr;
             element = element->NextSiblingElement(kind)) {
          const LaneletId id = id_attribute(*element, "ref");
          if (map.lanelets.find(id) == map.lanelets.end()) {
            fail(element->GetLineNum(),
                 fmt::format("<{}> ref is {}, must be the id of a lanelet of this file", kind, id));
          }
        }
      }
    }
  }

  const std::string& name_;
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
  return Reader(name).read(xml);
}

LaneletMap read_lanelet_map(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    throw std::runtime_error(file.string() + ": cannot be read, must be a CommonRoad 2020a file");
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
