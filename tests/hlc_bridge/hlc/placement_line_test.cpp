#include "hlc_bridge/hlc/placement_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::high_level_controller::placement_line_test {
namespace {

using testing::HasSubstr;

const scenario::Scenario& three_cars() {
  static const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml"});
  return scenario;
}

std::string line_of(VehicleId id, const Pose& measured) {
  const std::unique_ptr<controller::Controller> controller =
      scenario::make_controller(three_cars(), id);
  static_cast<void>(controller->stand_by(
      {.step = {1}, .active = {id}, .states = {{.vehicle = id, .pose = measured}}, .present = {}}));
  return placement_line(*controller);
}

TEST(PlacementLine, NamesRouteAndPlace) {
  const Pose start = scenario::measured_start(three_cars(), three_cars().vehicles[2]);
  const std::string line = line_of({3}, compose(start, {0.0, 0.030, 0.0}));
  EXPECT_THAT(line, HasSubstr("vehicle 3 selects route green at 1.5"));
  EXPECT_THAT(line, HasSubstr("30 mm beside its path"));
  EXPECT_THAT(line_of({9}, start), HasSubstr("vehicle 9 selects route green (best fit) at"));
}

TEST(PlacementLine, SaysHowFarAVehicleIsOffAndWhatIsAllowed) {
  const Pose start = scenario::measured_start(three_cars(), three_cars().vehicles[2]);
  const std::string turned = line_of({3}, compose(start, {0.0, 0.0, 2.0}));
  EXPECT_THAT(turned, HasSubstr("vehicle 3 fits no route: nearest is green at"));
  EXPECT_THAT(turned, HasSubstr("(must be <= 150 mm)"));
  EXPECT_THAT(turned, HasSubstr("(must be <= 0.600 rad)"));
  EXPECT_THAT(line_of({3}, {-1.0, -1.0, 0.0}), HasSubstr("is not on the map"));
}

TEST(StuckLine, NamesTheBudgetIfItWasUsedUp) {
  const std::unique_ptr<controller::Controller> controller =
      scenario::make_controller(three_cars(), {3});
  EXPECT_THAT(stuck_line(*controller, coordination::FallbackReason::kOffRoute),
              HasSubstr("no plan of 8 steps"));
  EXPECT_EQ(stuck_line(*controller, coordination::FallbackReason::kBudget),
            "vehicle 3: no new plan, the search used up max_expansions = " +
                std::to_string(three_cars().search.max_expansions));
}

}  // namespace
}  // namespace hlc::high_level_controller::placement_line_test
