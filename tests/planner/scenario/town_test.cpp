// Cars drawn on any lanelet of a map: the scenario `town`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "planner/common/text_file.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::scenario {
namespace {

using testing::HasSubstr;

const std::filesystem::path kScenarios =
    std::filesystem::path(test::source_folder()) / "launch_scripts/scenarios";

std::string error_of(const ScenarioChoices& choices) {
  try {
    static_cast<void>(read_scenario(choices));
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

TEST(TownScenario, EveryCarStartsAwayFromTheOthersWhereNoWaysFork) {
  const Scenario scenario = read_scenario({.file = kScenarios / "town.yaml"});
  const road::LaneletMap map = road::read_lanelet_map(*scenario.map_file);
  EXPECT_EQ(scenario.vehicles.size(), 100U);
  EXPECT_FALSE(overlapping_starts(scenario));
  std::set<road::LaneletId> starts;
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    EXPECT_TRUE(vehicle.path.is_closed());
    EXPECT_GT(vehicle.path.length_m(), 100.0);
    EXPECT_TRUE(starts.insert(vehicle.start_lanelet).second) << vehicle.name;
    for (const road::LaneletId before : map.lanelets.at(vehicle.start_lanelet).predecessors) {
      EXPECT_EQ(map.lanelets.at(before).successors.size(), 1U) << vehicle.name;
    }
  }
}

TEST(TownScenario, AnotherSeedDrawsOtherStarts) {
  const Scenario scenario = read_scenario({.file = kScenarios / "town.yaml", .cars = 5});
  const Scenario other = with_random_starts(scenario, 2);
  EXPECT_EQ(scenario.vehicles.size(), 5U);
  EXPECT_EQ(other.vehicles.size(), 5U);
  EXPECT_NE(scenario.vehicles[0].start_lanelet, other.vehicles[0].start_lanelet);
  EXPECT_NO_THROW(check_random_starts(scenario, 2));
}

TEST(TownScenario, MoreCarsThanPlacesAreRefused) {
  EXPECT_THAT(error_of({.file = kScenarios / "town.yaml",
                        .map_file = kScenarios / "../maps/lab_network.xml",
                        .cars = 200}),
              HasSubstr("--cars = 200, must be in 1 ... "));
  EXPECT_THAT(error_of({.file = kScenarios / "town.yaml",
                        .map_file = kScenarios / "../maps/lab_network.xml",
                        .cars = 200}),
              HasSubstr(": no more cars fit on the map's lanes"));
}

TEST(TownScenario, RoutesToDrawFromAreRefusedWithRandomRoutes) {
  const test::TemporaryFolder folder;
  std::string text = read_file(kScenarios / "town.yaml");
  const std::string draw = "draw: {cars: 100}";
  text.replace(text.find(draw), draw.size(), "draw: {cars: 100, routes: [a]}");
  test::put(folder / "town.yaml", text);
  EXPECT_THAT(error_of({.file = folder / "town.yaml"}), HasSubstr("draw.routes"));
}

}  // namespace
}  // namespace hlc::scenario
