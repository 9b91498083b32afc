#include "planner/road/lanelet_map.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "planner/common/xml_text.hpp"

namespace hlc {
namespace {

using tinyxml2::XMLElement;

/// Reads one document; knows the name that its error messages begin with.
class Reader {
 public:
  explicit Reader(const std::string& name) : name_(name) {}

  LaneletMap read(std::string_view xml) const {
    tinyxml2::XMLDocument document;
    if (document.Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS) {
      fail(document.ErrorLineNum(),
           std::string("not well-formed XML (") + document.ErrorName() + ")");
    }
    const XMLElement* root = document.RootElement();
    if (root == nullptr || std::strcmp(root->Name(), "commonRoad") != 0) {
      fail(root == nullptr ? 1 : root->GetLineNum(), "root element must be <commonRoad>");
    }
    const std::string_view version = attribute(*root, "commonRoadVersion");
    if (version != "2020a") {
      fail(root->GetLineNum(), "commonRoadVersion is " + quoted(version) + ", must be \"2020a\"");
    }
    LaneletMap map{.benchmark_id = std::string(attribute(*root, "benchmarkID")), .lanelets = {}};
    for (const XMLElement* element = root->FirstChildElement("lanelet"); element != nullptr;
         element = element->NextSiblingElement("lanelet")) {
      Lanelet lanelet = read_lanelet(*element);
      const LaneletId id = lanelet.id;
      if (!map.lanelets.emplace(id, std::move(lanelet)).second) {
        fail(element->GetLineNum(), "lanelet id " + std::to_string(id) + " is taken already");
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
    throw std::runtime_error(name_ + ":" + std::to_string(line) + ": " + what);
  }

  /// The value in quotes, without line breaks and cut short, so that an error stays one line.
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
           std::string("<") + element.Name() + "> needs the attribute " + attribute_name);
    }
    return value;
  }

  LaneletId id_attribute(const XMLElement& element, const char* attribute_name) const {
    const std::string_view text = attribute(element, attribute_name);
    LaneletId id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (error != std::errc{} || end != text.data() + text.size() || id < 1) {
      fail(element.GetLineNum(), std::string("<") + element.Name() + "> " + attribute_name +
                                     " is " + quoted(text) +
                                     ", must be a whole number from 1 to 2147483647");
    }
    return id;
  }

  const XMLElement& child(const XMLElement& element, const char* child_name) const {
    const XMLElement* found = element.FirstChildElement(child_name);
    if (found == nullptr) {
      fail(element.GetLineNum(),
           std::string("<") + element.Name() + "> needs a <" + child_name + ">");
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
           std::string("<") + axis + "> is " + quoted(text) + ", must be a finite number [m]");
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
      fail(element.GetLineNum(), std::string("<") + bound_name + "> has " +
                                     std::to_string(points.size()) + " points, must be at least 2");
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
      fail(element->GetLineNum(), std::string("<") + side + "> drivingDir is " + quoted(direction) +
                                      ", must be \"same\" or \"opposite\"");
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
      fail(element.GetLineNum(), "lanelet " + std::to_string(lanelet.id) + ": <leftBound> has " +
                                     std::to_string(lanelet.left_m.size()) +
                                     " points and <rightBound> " +
                                     std::to_string(lanelet.right_m.size()) + ", must be equal");
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
            fail(element->GetLineNum(), std::string("<") + kind + "> ref is " + std::to_string(id) +
                                            ", must be the id of a lanelet of this file");
          }
        }
      }
    }
  }

  const std::string& name_;
};

void write_bound(std::ostream& xml, const char* name, const std::vector<Point>& points_m) {
  xml << "    <" << name << ">\n";
  for (const Point& point : points_m) {
    xml << "      <point><x>" << point.x() << "</x><y>" << point.y() << "</y></point>\n";
  }
  xml << "    </" << name << ">\n";
}

void write_references(std::ostream& xml, const char* name, const std::vector<LaneletId>& ids) {
  for (const LaneletId id : ids) {
    xml << "    <" << name << " ref=\"" << id << "\"/>\n";
  }
}

void write_adjacent(std::ostream& xml, const char* name,
                    const std::optional<Lanelet::Adjacent>& adjacent) {
  if (adjacent) {
    xml << "    <" << name << " ref=\"" << adjacent->id << "\" drivingDir=\""
        << (adjacent->same_direction ? "same" : "opposite") << "\"/>\n";
  }
}

}  // namespace

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
  std::ifstream stream(file, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(file, ignored)) {
    throw std::runtime_error(file.string() + ": cannot be read, must be a CommonRoad 2020a file");
  }
  const std::string xml{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return parse_lanelet_map(xml, file.string());
}

std::string commonroad_head(const CommonRoadHead& head) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<commonRoad commonRoadVersion=\"2020a\" benchmarkID=\"" +
         xml_escaped(head.benchmark_id) + "\" date=\"2025-01-01\" author=\"" +
         xml_escaped(head.author) + "\" affiliation=\"none\" source=\"" + xml_escaped(head.source) +
         "\" timeStepSize=\"" + xml_escaped(head.time_step) +
         "\">\n"
         "  <location>\n"
         "    <geoNameId>-999</geoNameId>\n"
         "    <gpsLatitude>999</gpsLatitude>\n"
         "    <gpsLongitude>999</gpsLongitude>\n"
         "  </location>\n"
         "  <scenarioTags><urban/><intersection/></scenarioTags>\n";
}

std::string lanelets_to_xml(const LaneletMap& map) {
  std::ostringstream xml;
  xml.imbue(std::locale::classic());
  xml << std::fixed << std::setprecision(9);
  for (const auto& [id, lanelet] : map.lanelets) {
    xml << "  <lanelet id=\"" << id << "\">\n";
    write_bound(xml, "leftBound", lanelet.left_m);
    write_bound(xml, "rightBound", lanelet.right_m);
    write_references(xml, "predecessor", lanelet.predecessors);
    write_references(xml, "successor", lanelet.successors);
    write_adjacent(xml, "adjacentLeft", lanelet.adjacent_left);
    write_adjacent(xml, "adjacentRight", lanelet.adjacent_right);
    xml << "    <laneletType>urban</laneletType>\n  </lanelet>\n";
  }
  return xml.str();
}

std::string to_commonroad_xml(const LaneletMap& map) {
  return commonroad_head({.benchmark_id = map.benchmark_id,
                          .author = "generate_map",
                          .source = "generated",
                          .time_step = "0.2"}) +
         lanelets_to_xml(map) + "</commonRoad>\n";
}

void write_lanelet_map(const LaneletMap& map, const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::binary);
  stream << to_commonroad_xml(map);
  stream.close();
  if (!stream) {
    throw std::runtime_error(file.string() + ": cannot be written");
  }
}

}  // namespace hlc
