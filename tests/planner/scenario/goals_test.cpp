// The goals of a scenario's vehicles: where their paths end, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "planner/scenario/scenario.hpp"
#include "tests/planner/scenario/changed_scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::scenario::goals_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kScenarios = test::source_folder() + "/launch_scripts/scenarios/";

/// A goal of 0.3 m by 0.3 m for the first car of paper_three_cars, at its route.
std::string goal_at(const Point& at_m) {
  return "goal: {rectangle: {x_m: " + std::to_string(at_m.x()) +
         ", y_m: " + std::to_string(at_m.y()) + ", length_m: 0.3, width_m: 0.3}}";
}

test::TextChanges with(const std::string& goal) { return {{"{id: 1,", "{id: 1, " + goal + ","}}; }

class Goals : public testing::Test {
 protected:
  [[nodiscard]] const ScenarioVehicle& red() const { return shipped_.vehicles.front(); }
  /// A place on its route, so far ahead of its start.
  [[nodiscard]] Point ahead_m(double by_m) const { return red().path.at(red().start_s_m + by_m); }
  Scenario shipped_{read_scenario({.file = kScenarios + "paper_three_cars.yaml"})};
};

TEST_F(Goals, EndThePathInTheMiddleOfTheirFirstStretchAfterTheStart) {
  for (const double by_m : {1.0, 4.0, red().path.length_m() - 1.0}) {
    SCOPED_TRACE(by_m);
    const Scenario scenario =
        test::changed_scenario("paper_three_cars", "", with(goal_at(ahead_m(by_m))));
    const ScenarioVehicle& vehicle = scenario.vehicles.front();
    ASSERT_TRUE(vehicle.goal);
    EXPECT_FALSE(vehicle.path.is_closed());
    EXPECT_LE(vehicle.path.length_m(), red().start_s_m + by_m + 0.2);
    EXPECT_GT(vehicle.path.length_m(), red().start_s_m);
    EXPECT_LE(vehicle.goal->from_s_m, vehicle.path.length_m());
    EXPECT_TRUE(contains(vehicle.goal->area_m, vehicle.path.at(vehicle.path.length_m()), 1e-9));
    EXPECT_EQ(vehicle.start, red().start);
    EXPECT_EQ(vehicle.path.at(vehicle.start_s_m), red().path.at(red().start_s_m));
    EXPECT_TRUE(make_controller(scenario, vehicle.id)->route().goal);
    EXPECT_TRUE(scenario.vehicles[1].path.is_closed()) << "a car without a goal drives on forever";
  }
}

TEST_F(Goals, ThatTheRouteDoesNotMeetAreRefused) {
  EXPECT_THAT(test::error_of_scenario("paper_three_cars", "", with(goal_at({50.0, 50.0}))),
              AllOf(HasSubstr("vehicles[1].goal"),
                    HasSubstr("must be a region that the route of vehicle 1 (red) enters after its "
                              "start")));
}

TEST_F(Goals, HaveOneShapeAndNothingElse) {
  EXPECT_THAT(test::error_of_scenario("paper_three_cars", "", with("goal: {x_m: 1}")),
              HasSubstr("x_m"));
  EXPECT_THAT(test::error_of_scenario("paper_three_cars", "", with("goal: {}")),
              HasSubstr("the only one of rectangle, circle and polygon"));
}

TEST_F(Goals, WithRightOfWayAreRefusedByName) {
  EXPECT_THAT(test::error_of_scenario("paper_three_cars", "right_of_way: true",
                                      with(goal_at(ahead_m(1.0)))),
              AllOf(HasSubstr("vehicles[1].goal"), HasSubstr("must be absent with right_of_way")));
}

TEST_F(Goals, OnRandomRoutesEndThese) {
  const Scenario scenario = test::changed_scenario(
      "paper_three_cars", "", with(goal_at(ahead_m(1.0))), {.seed = 3, .routes = kRandomRoutes});
  EXPECT_TRUE(scenario.vehicles[0].goal);
  EXPECT_FALSE(scenario.vehicles[0].path.is_closed());
  EXPECT_TRUE(scenario.vehicles[1].path.is_closed());
}

}  // namespace
}  // namespace hlc::scenario::goals_test
