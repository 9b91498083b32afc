#include <gtest/gtest.h>

#include "planner/plot/scenario_data.hpp"
#include "planner/road/lanelet_map.hpp"
#include "tests/support/folders.hpp"

namespace hlc::plot {
namespace {

nlohmann::ordered_json data_of(const std::string& scenario) {
  return scenario_data(scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/" + scenario + ".yaml"}));
}

TEST(ScenarioData, HasLanesPathsVehiclesAndZones) {
  const auto data = data_of("reconfiguration");
  EXPECT_EQ(data["scenario"], "reconfiguration");
  const road::LaneletMap map =
      road::read_lanelet_map(test::source_folder() + "/launch_scripts/maps/lab_like.xml");
  ASSERT_EQ(data["lanelets"].size(), map.lanelets.size());
  const auto& [id, lanelet] = *map.lanelets.begin();
  EXPECT_EQ(data["lanelets"][0]["id"], id);
  EXPECT_EQ(data["lanelets"][0]["left_m"].size(), lanelet.left_m.size());
  EXPECT_EQ(data["lanelets"][0]["right_m"][1][0], lanelet.right_m[1].x());
  ASSERT_EQ(data["vehicles"].size(), 3U);
  EXPECT_EQ(data["vehicles"][1]["name"], "blue");
  EXPECT_EQ(data["vehicles"][1]["path"]["is_closed"], true);
  EXPECT_EQ(data["zones"]["zone"][0]["max_speed_mps"], 0.6);
  EXPECT_FALSE(data["zones"].contains("time"));
}

TEST(ScenarioData, StartsAreTheYawByWhichCarsArePlaced) {
  const scenario::Scenario ring = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_ring.yaml"});
  const auto data = scenario_data(ring);
  for (std::size_t i = 0; i < ring.vehicles.size(); ++i) {
    const Pose pose = scenario::measured_start(ring, ring.vehicles[i]);
    EXPECT_EQ(data["vehicles"][i]["start"]["yaw_rad"], pose.heading_rad);
    EXPECT_EQ(data["vehicles"][i]["start"]["x_m"], pose.x_m);
  }
}

TEST(ScenarioData, OpenGroundHasNoLanes) {
  const auto data = data_of("circle");
  EXPECT_EQ(data["has_map"], false);
  EXPECT_TRUE(data["lanelets"].empty());
  EXPECT_EQ(data["vehicles"].size(), 4U);
  EXPECT_TRUE(data["obstacles"].empty());
  EXPECT_EQ(data.dump(), data_of("circle").dump());
}

TEST(ScenarioData, HasTheObstacles) {
  const auto data = data_of("obstacle_field");
  ASSERT_FALSE(data["obstacles"].empty());
  EXPECT_FALSE(data["obstacles"][0]["name"].get<std::string>().empty());
  EXPECT_GE(data["obstacles"][0]["corners_m"].size(), 3U);
}

TEST(ScenarioData, HasTheGoalsOfTheCarsThatHaveOne) {
  const ConvexPolygon area_m{{{1.0, 1.0}, {2.0, 1.0}, {1.5, 2.0}}};
  scenario::Scenario circle = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/circle.yaml"});
  circle.vehicles[1].goal = road::Goal{.area_m = area_m};
  const auto data = scenario_data(circle);
  EXPECT_FALSE(data["vehicles"][0].contains("goal_m"));
  EXPECT_EQ(data["vehicles"][1]["goal_m"].dump(), "[[1.0,1.0],[2.0,1.0],[1.5,2.0]]");
}

}  // namespace
}  // namespace hlc::plot
