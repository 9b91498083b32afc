#include "planner/scenario/starts.hpp"

#include <gtest/gtest.h>

#include "tests/support/folders.hpp"

namespace hlc::scenario::starts_test {
namespace {

const std::string kScenarios = test::source_folder() + "/launch_scripts/scenarios/";

TEST(Starts, RandomOnesLieOnThePathsClearOfEachOtherAndTheSameForTheSameSeed) {
  const Scenario scenario = read_scenario({.file = kScenarios + "paper_three_cars.yaml"});
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scenario random = with_random_starts(scenario, seed);
    EXPECT_FALSE(overlapping_starts(random));
    const Scenario again = with_random_starts(scenario, seed);
    for (std::size_t i = 0; i < random.vehicles.size(); ++i) {
      const ScenarioVehicle& vehicle = random.vehicles[i];
      EXPECT_LT(vehicle.path.project(vehicle.start.position_m()).distance_m, 1e-9);
      EXPECT_EQ(vehicle.start.heading_rad, vehicle.path.heading_rad_at(vehicle.start_s_m));
      EXPECT_EQ(vehicle.start, again.vehicles[i].start);
    }
  }
  EXPECT_NE(with_random_starts(scenario, 1).vehicles[0].start,
            with_random_starts(scenario, 2).vehicles[0].start);
}

TEST(Starts, OverlapsAreFound) {
  Scenario scenario = read_scenario({.file = kScenarios + "paper_three_cars.yaml"});
  EXPECT_FALSE(overlapping_starts(scenario));
  scenario.vehicles[2].start = scenario.vehicles[1].start;
  EXPECT_EQ(overlapping_starts(scenario), (std::pair<std::size_t, std::size_t>{1, 2}));
}

TEST(Starts, OpenPathsHaveNoRandomOnes) {
  const Scenario circle = read_scenario({.file = kScenarios + "circle.yaml"});
  EXPECT_THROW(static_cast<void>(with_random_starts(circle, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::scenario::starts_test
