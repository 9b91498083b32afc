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
constexpr std::array kTypesForCars{"urban",           "interstate", "country",  "highway",
                                   "mainCarriageWay", "accessRamp", "exitRamp", "driveWay",
                                   "intersection",    "unknown"};
constexpr std::array kTypesForOthers{"sidewalk", "crosswalk", "bicycleLane", "busLane",
                                     "busStop",  "shoulder",  "border"};
constexpr std::array kMayBeCrossed{"dashed", "broad_dashed", "no_marking", "unknown"};

template <std::size_t size>
bool is_among(std::string_view name, const std::array<const char*, size>& names) {
  return std::ranges::find(names, name) != names.end();
}

/// Without blanks around it.
std::string_view text_in(const XMLElement& element) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::string_view text = element.GetText() == nullptr ? "" : element.GetText();
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

class RuleReader {
 public:
  RuleReader(std::string_view xml, const std::string& name) : file_(xml, name) {}

  [[nodiscard]] std::set<LaneletId> read() const {
    for_each(file_.root(), [&](const XMLElement& element) {
      if (!is_among(element.Name(), kInFile)) {
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
      if (!is_among(element.Name(), kInLanelet)) {
        file_.fail(element, fmt::format("lanelet {}: <{}> is not regarded, must be absent",
                                        file_.id_attribute(lanelet, "id"), element.Name()));
      }
      if (std::string_view(element.Name()) == "laneletType") check_type(lanelet, element);
    });
    for (const auto& [bound, neighbour] :
         {std::pair("leftBound", "adjacentLeft"), std::pair("rightBound", "adjacentRight")}) {
      check_line(lanelet, bound, neighbour);
    }
  }

  void check_type(const XMLElement& lanelet, const XMLElement& type) const {
    const std::string_view text = text_in(type);
    if (is_among(text, kTypesForCars) || is_among(text, kTypesForOthers)) return;
    file_.fail(type,
               fmt::format("lanelet {}: <laneletType> is {}, must be one of {}, {}",
                           file_.id_attribute(lanelet, "id"), CommonRoadDocument::quoted(text),
                           fmt::join(kTypesForCars, ", "), fmt::join(kTypesForOthers, ", ")));
  }

  void check_line(const XMLElement& lanelet, const char* bound, const char* neighbour) const {
    const XMLElement* beside = lanelet.FirstChildElement(neighbour);
    const XMLElement* line = file_.child(lanelet, bound).FirstChildElement("lineMarking");
    if (beside == nullptr || line == nullptr || file_.attribute(*beside, "drivingDir") != "same") {
      return;
    }
    if (is_among(text_in(*line), kMayBeCrossed)) return;
    file_.fail(
        *line,
        fmt::format("lanelet {}: <lineMarking> of <{}> is {}, must be one of {} where "
                    "a lanelet of the same direction is beside: cars may cross it",
                    file_.id_attribute(lanelet, "id"), bound,
                    CommonRoadDocument::quoted(text_in(*line)), fmt::join(kMayBeCrossed, ", ")));
  }

  [[nodiscard]] static bool is_for_cars(const XMLElement& lanelet) {
    bool has_users = false;
    bool has_cars = false;
    bool has_other_type = false;
    for_each(lanelet, [&](const XMLElement& element) {
      const std::string_view name = element.Name();
      const std::string_view text = text_in(element);
      has_other_type |= name == "laneletType" && is_among(text, kTypesForOthers);
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
