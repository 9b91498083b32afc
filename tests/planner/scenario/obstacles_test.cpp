// The obstacles of a scenario: what is refused, and who knows of them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "planner/common/text_file.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/planner/scenario/changed_scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::scenario::obstacles_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kFolder = test::source_folder() + "/launch_scripts/";

TEST(Obstacles, AreReadInTheirOrder) {
  const Scenario scenario = test::changed_scenario("circle", R"(
obstacles:
  - {name: parked van, rectangle: {x_m: 2.25, y_m: 2.0, length_m: 0.4, width_m: 0.2}}
  - {name: cone, circle: {x_m: 1.25, y_m: 2.5, radius_m: 0.05}}
  - {name: wall, polygon: [[0, 0], [4, 0], [4, 0.1], [0, 0.1]]})");
  ASSERT_EQ(scenario.obstacles.size(), 3U);
  EXPECT_EQ(scenario.obstacles[0].name, "parked van");
  EXPECT_EQ(scenario.obstacles[1].area_m.vertices_m.size(), 16U);
  EXPECT_EQ(scenario.obstacles[2].area_m.vertices_m.size(), 4U);
}

TEST(Obstacles, NamesAreThereAndUniqueAndNotMoreThanAHundred) {
  EXPECT_THAT(
      test::error_of_scenario("circle", "obstacles: [{circle: {x_m: 0, y_m: 0, radius_m: 0.1}}]"),
      HasSubstr("obstacles[1].name"));
  EXPECT_THAT(
      test::error_of_scenario("circle",
                              "obstacles: [{name: a, circle: {x_m: 0, y_m: 0, radius_m: 0.1}}, "
                              "{name: a, circle: {x_m: 9, y_m: 0, radius_m: 0.1}}]"),
      HasSubstr("obstacles[2].name = a, must be unique"));
  EXPECT_THAT(test::error_of_scenario("circle",
                                      "obstacles: [{name: a, colour: red, "
                                      "circle: {x_m: 0, y_m: 0, radius_m: 0.1}}]"),
              HasSubstr("colour"));
  std::string many = "obstacles:\n";
  for (int i = 0; i <= 100; ++i) {
    many += "  - {name: " + std::to_string(i) + ", circle: {x_m: 50, y_m: 0, radius_m: 0.1}}\n";
  }
  EXPECT_THAT(test::error_of_scenario("circle", many),
              HasSubstr("must be a list of at most 100, got 101"));
}

/// The paper's three cars on their map with a further element.
Scenario on_map_with(const std::string& element) {
  std::string map = read_file(kFolder + "maps/lab_like.xml");
  map.insert(map.rfind("</commonRoad>"), element);
  const test::TemporaryFolder folder;
  write_file(folder / "map.xml", map);
  return read_scenario(
      {.file = kFolder + "scenarios/paper_three_cars.yaml", .map_file = folder / "map.xml"});
}

std::string parked_at(double x_m, double y_m) {
  return fmt::format(
      "<staticObstacle id=\"4711\"><type>parkedVehicle</type><shape><rectangle><length>0.2</length>"
      "<width>0.1</width></rectangle></shape><initialState><position><point><x>{}</x><y>{}</y>"
      "</point></position><orientation><exact>0</exact></orientation><time><exact>0</exact></time>"
      "</initialState></staticObstacle>",
      x_m, y_m);
}

// A car drove through a parked vehicle of the file.
TEST(Obstacles, OfTheMapStandInTheScenario) {
  const Scenario scenario = on_map_with(parked_at(2.25, 2.0));
  ASSERT_EQ(scenario.obstacles.size(), 1U);
  EXPECT_EQ(scenario.obstacles[0].name, "parkedVehicle 4711");
  EXPECT_TRUE(make_controller(scenario, {1})->has_obstacles());
}

TEST(Obstacles, OfTheMapAreRefusedInAStartOrIfTheyMove) {
  const auto refusal = [](const std::string& element) {
    try {
      static_cast<void>(on_map_with(element));
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Pose start = on_map_with("").vehicles.at(1).start;
  EXPECT_THAT(refusal(parked_at(start.x_m, start.y_m)),
              AllOf(HasSubstr("map.xml: parkedVehicle 4711, must be clear of"),
                    HasSubstr("vehicle 2 (blue)")));
  EXPECT_THAT(refusal("<dynamicObstacle id=\"4712\"/>"),
              HasSubstr("<dynamicObstacle> \"4712\": is not regarded, must be absent"));
}

TEST(Obstacles, AStartInAnObstacleIsRefusedAndBothAreNamed) {
  // Car 1 starts at (3.75, 2.0); the margin of 10 mm counts.
  const auto obstacle_at = [](const std::string& x_m) {
    return "obstacles: [{name: cone, rectangle: {x_m: " + x_m +
           ", y_m: 2.0, length_m: 0.1, width_m: 0.1}}]";
  };
  EXPECT_THAT(test::error_of_scenario("circle", obstacle_at("3.585")),
              AllOf(HasSubstr("obstacles[1].name = cone, must be clear of"),
                    HasSubstr("vehicle 1 (car 1)"), HasSubstr("(3.750, 2.000)")));
  EXPECT_EQ(test::error_of_scenario("circle", obstacle_at("3.575")), "");
}

TEST(Obstacles, EveryControllerOfTheScenarioHasThem) {
  const Scenario scenario = test::changed_scenario(
      "circle", "obstacles: [{name: cone, circle: {x_m: 2.25, y_m: 2.0, radius_m: 0.1}}]");
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    EXPECT_TRUE(make_controller(scenario, vehicle.id)->has_obstacles());
  }
  EXPECT_TRUE(make_controller(scenario, VehicleId{200})->has_obstacles()) << "not named by it";
}

TEST(Obstacles, NoneLiesOnARouteWithRightOfWay) {
  const Scenario cars = read_scenario({.file = kFolder + "scenarios/lab_cars.yaml"});
  const road::ReferencePath& path = cars.vehicles.front().path;
  const Point on_m = path.at(cars.vehicles.front().start_s_m + 0.6);
  const std::string cone = "obstacles: [{name: cone, circle: {x_m: " + std::to_string(on_m.x()) +
                           ", y_m: " + std::to_string(on_m.y()) + ", radius_m: 0.02}}]";
  EXPECT_THAT(test::error_of_scenario("lab_cars", cone),
              AllOf(HasSubstr("right_of_way"), HasSubstr("cone must be beside the route of")));
  EXPECT_EQ(test::error_of_scenario(
                "lab_cars", "obstacles: [{name: far, circle: {x_m: 50, y_m: 50, radius_m: 1}}]"),
            "");
}

TEST(Obstacles, CarsAreDrawnClearOfThem) {
  Scenario cars = read_scenario({.file = kFolder + "scenarios/lab_cars.yaml"});
  cars.shared_lane_width_m.reset();
  cars.conflicts.reset();
  const ScenarioVehicle first = cars.vehicles.front();
  cars.obstacles = {{.name = "on its start", .area_m = footprint_area({0.1, 0.1}, first.start)}};
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_FALSE(start_in_obstacle(with_random_starts(cars, seed)));
  }
  Scenario three = read_scenario({.file = kFolder + "scenarios/paper_three_cars.yaml"});
  three.obstacles = {
      {.name = "on its start", .area_m = footprint_area({0.3, 0.3}, three.vehicles.front().start)}};
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_FALSE(start_in_obstacle(with_random_starts(three, seed)));
  }
}

}  // namespace
}  // namespace hlc::scenario::obstacles_test
