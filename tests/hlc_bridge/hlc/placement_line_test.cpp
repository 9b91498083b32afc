#include "hlc_bridge/hlc/placement_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

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

/// As the line states, the car can be moved from there into the lanes of its route.
void expect_leads_onto_green(const Pose& beside) {
  const std::string line = line_of({3}, beside);
  SCOPED_TRACE(line);
  const std::size_t at = line.find("move it by x ");
  ASSERT_NE(at, std::string::npos);
  double x_m{};
  double y_m{};
  double to_x_m{};
  double to_y_m{};
  double turn_rad{};
  ASSERT_EQ(std::sscanf(line.c_str() + at,
                        "move it by x %lf m, y %lf m to (%lf, %lf) and turn it by %lf rad", &x_m,
                        &y_m, &to_x_m, &to_y_m, &turn_rad),
            5);
  EXPECT_NEAR(beside.x_m + x_m, to_x_m, 0.011);
  EXPECT_NEAR(beside.y_m + y_m, to_y_m, 0.011);
  const Pose moved{.x_m = to_x_m, .y_m = to_y_m, .heading_rad = beside.heading_rad + turn_rad};
  EXPECT_THAT(line_of({3}, moved), HasSubstr("selects route green"));
}

TEST(PlacementLine, SaysInWhichDirectionAndHowFarAVehicleIsToBeMovedAndTurned) {
  const Pose start = scenario::measured_start(three_cars(), three_cars().vehicles[2]);
  for (const double turned_rad : {-0.9, 0.0, 0.9}) {
    Pose beside = compose(start, {0.0, 0.0, turned_rad});
    beside.y_m -= 0.4;
    expect_leads_onto_green(beside);
  }
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
