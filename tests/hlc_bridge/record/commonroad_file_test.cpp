#include "hlc_bridge/record/commonroad_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

namespace hlc::record {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using tinyxml2::XMLElement;

constexpr double kPi = std::numbers::pi;

std::vector<ExportedVehicle> two_vehicles() {
  std::vector<ExportedVehicle> vehicles;
  for (std::uint8_t id : {std::uint8_t{3}, std::uint8_t{7}}) {
    ExportedVehicle vehicle{.id = {id}, .planned = {}, .driven = {}};
    for (int i = 0; i < 3; ++i) {
      const vehicle::State state{.pose = {0.1 * i + id, 1.0 / 3.0, 0.1 + 4.0 * kPi},
                                 .speed_mps = 0.8,
                                 .steering_rad = -0.12};
      vehicle.planned.push_back(state);
      vehicle.driven.push_back(state);
    }
    vehicles.push_back(vehicle);
  }
  return vehicles;
}

road::LaneletMap small_map(road::LaneletId id) {
  return {.benchmark_id = "ZAM_A&B-1_1_T-1",
          .lanelets = {{id,
                        {.id = id,
                         .left_m = {{0.0, 1.0}, {9.0, 1.0}},
                         .right_m = {{0.0, 0.0}, {9.0, 0.0}},
                         .predecessors = {},
                         .successors = {},
                         .adjacent_left = {},
                         .adjacent_right = {}}}}};
}

std::string text_at(const XMLElement* element, std::initializer_list<const char*> path) {
  for (const char* name : path) {
    element = element == nullptr ? nullptr : element->FirstChildElement(name);
  }
  return element == nullptr || element->GetText() == nullptr ? "" : element->GetText();
}

TEST(CommonRoadFile, HoldsTheMapMotionsAndProblemsWithIdsOfTheirOwn) {
  const std::string xml = commonroad_xml(small_map(5), {}, two_vehicles(), {}, 0.01);
  EXPECT_EQ(road::parse_lanelet_map(xml, "xml"), small_map(5));
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(xml.c_str()), tinyxml2::XML_SUCCESS);
  EXPECT_STREQ(document.RootElement()->Attribute("timeStepSize"), "0.01");
  std::set<int> ids;
  std::multiset<std::string> kinds;
  for (const XMLElement* e = document.RootElement()->FirstChildElement(); e != nullptr;
       e = e->NextSiblingElement()) {
    if (e->Attribute("id") == nullptr) continue;
    ids.insert(e->IntAttribute("id"));
    kinds.insert(e->Name());
  }
  EXPECT_EQ(ids, (std::set<int>{5, kProblemIds + 3, kProblemIds + 7, kPlannedIds + 3,
                                kPlannedIds + 7, kDrivenIds + 3, kDrivenIds + 7}));
  EXPECT_EQ(kinds.count("dynamicObstacle"), 4U);
  EXPECT_EQ(kinds.count("planningProblem"), 2U);
}

TEST(CommonRoadFile, ObstaclesStandAroundTheMeanOfTheirCorners) {
  const ConvexPolygon area_m{{{1.0, 2.0}, {3.0, 2.0}, {2.0, 5.0}}};
  const std::string xml = commonroad_xml(small_map(5), {}, two_vehicles(), {area_m, area_m}, 0.01);
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(xml.c_str()), tinyxml2::XML_SUCCESS);
  const XMLElement* first = document.RootElement()->FirstChildElement("staticObstacle");
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->IntAttribute("id"), kObstacleIds + 1);
  EXPECT_EQ(text_at(first, {"initialState", "position", "point", "x"}), "2.000000000");
  EXPECT_EQ(text_at(first, {"initialState", "position", "point", "y"}), "3.000000000");
  EXPECT_EQ(text_at(first, {"initialState", "time", "exact"}), "0");
  EXPECT_EQ(text_at(first, {"shape", "polygon", "point", "x"}), "-1.000000000");
  EXPECT_EQ(text_at(first, {"shape", "polygon", "point", "y"}), "-1.000000000");
  const XMLElement* second = first->NextSiblingElement();
  EXPECT_EQ(second->IntAttribute("id"), kObstacleIds + 2);
  EXPECT_STREQ(second->NextSiblingElement()->Name(), "dynamicObstacle");
}

TEST(CommonRoadFile, StatesHaveNineDecimalsAndWrappedAngles) {
  const std::string xml = commonroad_xml(small_map(5), {}, two_vehicles(), {}, 0.01);
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(xml.c_str()), tinyxml2::XML_SUCCESS);
  const XMLElement* planned = document.RootElement()->FirstChildElement("dynamicObstacle");
  const XMLElement* last = planned->FirstChildElement("trajectory")->LastChildElement("state");
  EXPECT_EQ(text_at(last, {"position", "point", "x"}), "3.200000000");
  EXPECT_EQ(text_at(last, {"position", "point", "y"}), "0.333333333");
  EXPECT_EQ(text_at(last, {"orientation", "exact"}), "0.100000000");
  EXPECT_EQ(text_at(last, {"time", "exact"}), "2");
  EXPECT_EQ(text_at(last, {"velocity", "exact"}), "0.800000000");
  EXPECT_EQ(text_at(last, {"steeringAngle", "exact"}), "-0.120000000");
  EXPECT_EQ(text_at(planned, {"shape", "rectangle", "width"}), "0.107000000");
  const XMLElement* driven = planned->NextSiblingElement("dynamicObstacle");
  EXPECT_EQ(driven->IntAttribute("id"), kDrivenIds + 3);
  EXPECT_EQ(text_at(driven, {"initialState", "steeringAngle", "exact"}), "");
}

TEST(CommonRoadFile, RefusesLaneletsThatTakeTheIdsOfVehicles) {
  const auto write = [](road::LaneletId id) {
    return [id] { static_cast<void>(commonroad_xml(small_map(id), {}, two_vehicles(), {}, 0.01)); };
  };
  EXPECT_NO_THROW(write(kProblemIds)());
  EXPECT_THAT(write(kProblemIds + 1), ThrowsMessage<std::runtime_error>(HasSubstr("1000001")));
}

TEST(OpenGround, HoldsAllPositions) {
  const road::LaneletMap ground = open_ground(two_vehicles(), {});
  const road::Lanelet& lanelet = ground.lanelets.at(1);
  EXPECT_DOUBLE_EQ(lanelet.right_m.front().x(), 3.0 - 0.5);
  EXPECT_DOUBLE_EQ(lanelet.right_m.front().y(), 1.0 / 3.0 - 0.5);
  EXPECT_DOUBLE_EQ(lanelet.left_m.back().x(), 7.2 + 0.5);
  EXPECT_DOUBLE_EQ(lanelet.left_m.back().y(), 1.0 / 3.0 + 0.5);
  const ConvexPolygon beside_m{{{4.0, -2.0}, {5.0, -2.0}, {5.0, -1.0}}};
  EXPECT_DOUBLE_EQ(open_ground(two_vehicles(), {beside_m}).lanelets.at(1).right_m.front().y(),
                   -2.5);
}

}  // namespace
}  // namespace hlc::record
