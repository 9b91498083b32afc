#include "planner/road/lanelets_for_cars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "planner/road/commonroad_document.hpp"

namespace hlc::road {
namespace {

using tinyxml2::XMLElement;

/// Those of map_obstacles.hpp are refused there.
constexpr std::array kInFile{
    "location",        "scenarioTags",        "lanelet",         "intersection", "staticObstacle",
    "dynamicObstacle", "environmentObstacle", "phantomObstacle", "trafficSign",  "trafficLight",
    "obstacle",        "planningProblem"};
constexpr std::array kInLanelet{"leftBound",   "rightBound",   "predecessor",
                                "successor",   "adjacentLeft", "adjacentRight",
                                "laneletType", "userOneWay",   "userBidirectional"};
constexpr std::array kNotForCars{"sidewalk", "crosswalk", "bicycleLane",
                                 "busLane",  "shoulder",  "border"};

std::string_view text_in(const XMLElement& element) {
  return element.GetText() == nullptr ? "" : element.GetText();
}

class RuleReader {
 public:
  RuleReader(std::string_view xml, const std::string& name) : file_(xml, name) {}

  [[nodiscard]] std::set<LaneletId> read() const {
    for_each(file_.root(), [&](const XMLElement& element) {
      if (std::ranges::find(kInFile, std::string_view(element.Name())) == kInFile.end()) {
        file_.fail(element, fmt::format("<{}> is not regarded, must be absent", element.Name()));
      }
    });
    std::set<LaneletId> ids;
    CommonRoadDocument::for_each_child(file_.root(), "lanelet", [&](const XMLElement& lanelet) {
      check(lanelet);
      if (is_for_cars(lanelet)) ids.insert(file_.id_attribute(lanelet, "id"));
    });
    return ids;
  }

 private:
  static void for_each(const XMLElement& element,
                       const std::function<void(const XMLElement&)>& visit) {
    for (const XMLElement* one = element.FirstChildElement(); one != nullptr;
         one = one->NextSiblingElement()) {
      visit(*one);
    }
  }

  void check(const XMLElement& lanelet) const {
    for_each(lanelet, [&](const XMLElement& element) {
      if (std::ranges::find(kInLanelet, std::string_view(element.Name())) != kInLanelet.end()) {
        return;
      }
      file_.fail(element, fmt::format("lanelet {}: <{}> is not regarded, must be absent",
                                      file_.id_attribute(lanelet, "id"), element.Name()));
    });
    for (const auto& [bound, neighbour] :
         {std::pair("leftBound", "adjacentLeft"), std::pair("rightBound", "adjacentRight")}) {
      check_line(lanelet, bound, neighbour);
    }
  }

  void check_line(const XMLElement& lanelet, const char* bound, const char* neighbour) const {
    const XMLElement* beside = lanelet.FirstChildElement(neighbour);
    const XMLElement* line = file_.child(lanelet, bound).FirstChildElement("lineMarking");
    if (beside == nullptr || line == nullptr || file_.attribute(*beside, "drivingDir") != "same") {
      return;
    }
    if (text_in(*line) != "solid" && text_in(*line) != "broad_solid") return;
    file_.fail(*line, fmt::format("lanelet {}: <lineMarking> of <{}> is {}, must be none that cars "
                                  "must not cross, where a lanelet of the same direction is beside",
                                  file_.id_attribute(lanelet, "id"), bound, text_in(*line)));
  }

  [[nodiscard]] static bool is_for_cars(const XMLElement& lanelet) {
    bool has_users = false;
    bool has_cars = false;
    bool has_other_type = false;
    for_each(lanelet, [&](const XMLElement& element) {
      const std::string_view name = element.Name();
      const std::string_view text = text_in(element);
      has_other_type |=
          name == "laneletType" && std::ranges::find(kNotForCars, text) != kNotForCars.end();
      if (name != "userOneWay" && name != "userBidirectional") return;
      has_users = true;
      has_cars |= text == "vehicle" || text == "car";
    });
    return !has_other_type && (!has_users || has_cars);
  }

  CommonRoadDocument file_;
};

}  // namespace

std::set<LaneletId> parse_lanelets_for_cars(std::string_view xml, const std::string& name) {
  return RuleReader(xml, name).read();
}

}  // namespace hlc::road
