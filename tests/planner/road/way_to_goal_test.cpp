#include "planner/road/way_to_goal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "planner/road/lanelets_for_cars.hpp"
#include "planner/road/route.hpp"
#include "tests/support/commonroad_samples.hpp"

namespace hlc::road::way_to_goal_test {
namespace {

using test::CommonRoadSketch;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr Footprint kCar{4.5, 1.6};
constexpr Pose kStart{10.0, 0.0, 0.0};

std::string box_at(double x_m, double y_m) {
  return test::rectangle_at({x_m, y_m, 0.0}, {10.0, 3.0});
}

/// 1 leads to 2, which forks into 3, 100 m long, and 4 and then 5, both 20 m; all of these to 6.
/// 7 is to the left of 1, and 8 leads against them.
CommonRoadSketch network() {
  const double beyond_m = std::sqrt(50.0 * 50.0 - 20.0 * 20.0);
  return CommonRoadSketch()
      .lane(1, test::straight({0.0, 0.0}, {40.0, 0.0}))
      .lane(2, test::straight({40.0, 0.0}, {60.0, 0.0}))
      .lane(3, {{60.0, 0.0, 0.0}, {80.0, beyond_m, 0.0}, {100.0, 0.0, 0.0}})
      .lane(4, test::straight({60.0, 0.0}, {80.0, 0.0}))
      .lane(5, test::straight({80.0, 0.0}, {100.0, 0.0}))
      .lane(6, test::straight({100.0, 0.0}, {140.0, 0.0}))
      .lane(7, test::straight({0.0, 3.6}, {40.0, 3.6}))
      .lane(8, test::straight({40.0, -20.0}, {0.0, -20.0}))
      .joined(1, 2)
      .joined(2, 3)
      .joined(2, 4)
      .joined(4, 5)
      .joined(3, 6)
      .joined(5, 6)
      .beside(7, 1);
}

WayToGoal way_of(const CommonRoadSketch& sketch) {
  const std::string xml = sketch.xml();
  return way_to_goal(parse_lanelet_map(xml, "sketch"), parse_lanelets_for_cars(xml, "sketch"),
                     parse_planning_problems(xml, "sketch").front(), kCar);
}

std::string refusal(const CommonRoadSketch& sketch) {
  try {
    static_cast<void>(way_of(sketch));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(WayToGoal, IsTheShortestOne) {
  const WayToGoal way = way_of(network().problem(7, kStart, {box_at(120.0, 0.0)}));
  EXPECT_THAT(way.lanelets, ElementsAre(1, 2, 4, 5, 6));
  EXPECT_NEAR(way.start_s_m, 10.0, 1e-9);
  EXPECT_NEAR(way.start_left_m, 0.0, 1e-9);
  EXPECT_NEAR(way.stretch_in_goal.from_s_m, 115.0, 1e-6);
  EXPECT_NEAR(way.stretch_in_goal.to_s_m, 125.0, 1e-6);
}

TEST(WayToGoal, LeadsToALaneletByItsNumber) {
  const CommonRoadSketch sketch = network();
  EXPECT_THAT(way_of(CommonRoadSketch(sketch).problem(7, kStart, {test::lanelet_ref(5)})).lanelets,
              ElementsAre(1, 2, 4, 5, 6))
      << "on, since the way is in the lanelet up to its end";
  EXPECT_THAT(
      refusal(CommonRoadSketch(sketch).problem(7, kStart, {test::lanelet_ref(99)})),
      HasSubstr("planning problem 7: position of the goal state has lanelet 99, must be one "
                "of the file"));
}

TEST(WayToGoal, StartsBesideThePathWhereThePositionIs) {
  const WayToGoal way = way_of(network().problem(7, {12.0, -0.7, 0.2}, {box_at(120.0, 0.0)}));
  EXPECT_NEAR(way.start_s_m, 12.0, 1e-9);
  EXPECT_NEAR(way.start_left_m, -0.7, 1e-9);
  EXPECT_NEAR(way.start_turned_rad, 0.2, 1e-9);
}

TEST(WayToGoal, LeadsToALaneBesideByAStartBesideIt) {
  const WayToGoal way = way_of(network().problem(7, {10.0, 3.6, 0.0}, {box_at(50.0, 0.0)}));
  EXPECT_THAT(way.lanelets, ElementsAre(1, 2));
  EXPECT_NEAR(way.start_left_m, 3.6, 1e-9);
  const WayToGoal there = way_of(network().problem(7, kStart, {box_at(30.0, 3.6)}));
  EXPECT_THAT(there.lanelets, ElementsAre(7));
  EXPECT_NEAR(there.start_left_m, -3.6, 1e-9);
}

TEST(WayToGoal, LeadsRoundACircuitToAPlaceBehindTheStart) {
  CommonRoadSketch sketch;
  sketch.lane(1, test::arc({0.0, 0.0, 0.0}, 20.0, std::numbers::pi))
      .lane(2, test::arc({0.0, 40.0, std::numbers::pi}, 20.0, std::numbers::pi))
      .joined(1, 2)
      .joined(2, 1);
  const WayToGoal way = way_of(
      sketch.problem(7, {19.9, 18.0, 1.47}, {test::rectangle_at({9.6, 2.45, 0.5}, {9.0, 3.0})}));
  EXPECT_THAT(way.lanelets, ElementsAre(1, 2, 1));
}

TEST(WayToGoal, IsThatToTheFirstGoalStateWithAWay) {
  const WayToGoal way =
      way_of(network().problem(7, kStart, {test::lanelet_ref(8), box_at(50.0, 0.0)}));
  EXPECT_EQ(way.goal_state, 1U);
  EXPECT_THAT(way.lanelets, ElementsAre(1, 2));
}

TEST(WayToGoal, ThatDoesNotExistIsRefused) {
  EXPECT_THAT(refusal(network().problem(7, kStart, {test::lanelet_ref(8)})),
              HasSubstr("planning problem 7: position of the goal state, must be reached"));
  EXPECT_THAT(refusal(network().problem(7, kStart, {box_at(10.0, 0.0)})),
              HasSubstr("is in the region of a goal state"));
}

TEST(WayToGoal, FromABadStartIsRefused) {
  const std::vector<std::string> goal{box_at(120.0, 0.0)};
  EXPECT_THAT(refusal(network().problem(7, {10.0, 9.0, 0.0}, goal)),
              HasSubstr("position of the initial state, must be in a lanelet for cars"));
  EXPECT_THAT(refusal(network().problem(7, {10.0, 0.0, 3.0}, goal)),
              HasSubstr("is 3.000 rad off the direction of lanelet 1, must be <= 0.6 rad"));
  EXPECT_THAT(refusal(network().problem(7, {1.0, 0.0, 0.0}, goal)),
              HasSubstr("the whole car is on it"));
}

TEST(WayToGoal, ToAGoalThatIsTooShortIsRefused) {
  EXPECT_THAT(
      refusal(network().problem(7, kStart, {test::rectangle_at({50.0, 0.0, 0.0}, {4.0, 3.0})})),
      HasSubstr("planning problem 7: position of the goal state: the way is in its region for 4.00 "
                "m, must be >= 4.5 m, the car's length"));
}

TEST(WayToGoal, ToAGoalWhereACarMayNotStandIsRefused) {
  const auto with = [](const std::string& more) {
    return network().in_goals(more).problem(7, kStart, {box_at(50.0, 0.0)});
  };
  const auto between = [](const std::string& name, const std::string& from, const std::string& to) {
    return "<" + name + "><intervalStart>" + from + "</intervalStart><intervalEnd>" + to +
           "</intervalEnd></" + name + ">";
  };
  EXPECT_EQ(refusal(with(between("velocity", "0", "8"))), "");
  EXPECT_THAT(refusal(with(between("velocity", "4", "8"))),
              HasSubstr("velocity of the goal state is in 4 ... 8 m/s, must include 0"));
  EXPECT_EQ(refusal(with(between("orientation", "-0.7", "0.7"))), "");
  EXPECT_EQ(refusal(with(between("orientation", "5.6", "6.9"))), "") << "the same, one turn on";
  EXPECT_THAT(refusal(with(between("orientation", "-0.5", "0.7"))),
              HasSubstr("orientation of the goal state is in -0.5 ... 0.7 rad, must include"));
}

TEST(WayToGoal, UsesNoLaneOfOthersAndPassesNoneBeside) {
  const auto closed = [](int id) {
    std::string xml = network().problem(7, kStart, {box_at(120.0, 0.0)}).xml();
    const std::size_t lanelet = xml.find("<lanelet id=\"" + std::to_string(id) + "\"");
    return xml.insert(xml.find("<laneletType>", lanelet), "<userOneWay>bus</userOneWay>");
  };
  const auto way = [](const std::string& xml) {
    return way_to_goal(parse_lanelet_map(xml, "sketch"), parse_lanelets_for_cars(xml, "sketch"),
                       parse_planning_problems(xml, "sketch").front(), kCar);
  };
  EXPECT_THAT(way(closed(4)).lanelets, ElementsAre(1, 2, 3, 6));
  try {
    static_cast<void>(way(closed(7)));
    ADD_FAILURE() << "cars would use the lane beside";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("is beside lanelet 7 of the same direction"));
  }
}

}  // namespace
}  // namespace hlc::road::way_to_goal_test
