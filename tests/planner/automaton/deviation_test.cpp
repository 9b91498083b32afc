#include "planner/automaton/deviation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::automaton {
namespace {

const UniversalAutomaton& automaton() { return *paper_automaton(); }

double deviation_m(const Pose& measured, const vehicle::State& planned) {
  return footprint_deviation_m(measured, planned, automaton().vehicle, automaton().identified);
}

/// Where the vehicle is if it is as planned, with the yaw of steady state.
Pose as_planned(const vehicle::State& planned) {
  Pose pose = planned.pose;
  pose.heading_rad +=
      yaw_minus_heading_rad(planned.steering_rad, automaton().vehicle, automaton().identified);
  return pose;
}

TEST(FootprintDeviation, IsZeroAtThePlannedHeadingAndAtTheYawThatBelongsToIt) {
  for (const Trim& trim : automaton().trims) {
    const vehicle::State planned{
        .pose = {1.0, 2.0, 0.7}, .speed_mps = trim.speed_mps, .steering_rad = trim.steering_rad};
    EXPECT_NEAR(deviation_m(planned.pose, planned), 0.0, 1e-9);
    EXPECT_NEAR(deviation_m(as_planned(planned), planned), 0.0, 1e-9);
    const Pose mapped = pose_of_measured(as_planned(planned), planned.steering_rad,
                                         automaton().vehicle, automaton().identified);
    EXPECT_NEAR(mapped.heading_rad, 0.7, 1e-12);
  }
}

TEST(FootprintDeviation, OfATurnedVehicleIsAboutHalfItsLengthTimesTheAngle) {
  const vehicle::State planned{.pose = {1.0, 2.0, 0.7}};
  for (const double turn_rad : {0.02, 0.05, 0.09}) {
    Pose pose = as_planned(planned);
    pose.heading_rad += turn_rad;
    EXPECT_NEAR(deviation_m(pose, planned), 0.110 * turn_rad, 0.1 * 0.110 * turn_rad);
  }
}

TEST(FootprintDeviation, WithinTheMarginTheVehicleIsInsideTheSweptArea) {
  constexpr unsigned kSeed = 7;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double margin_m = automaton().vehicle.safety_margin_m;
  int inside = 0;
  for (const Maneuver& maneuver : automaton().maneuvers) {
    for (int i = 0; i < 200; ++i) {
      const double time_s = 0.5 * (1.0 + unit(random)) * maneuver.duration_s;
      const vehicle::State planned = state_at(maneuver, time_s, automaton().vehicle);
      Pose measured = as_planned(planned);
      measured.x_m += margin_m * unit(random);
      measured.y_m += margin_m * unit(random);
      measured.heading_rad += 0.1 * unit(random);
      if (deviation_m(measured, planned) > margin_m) continue;
      ++inside;
      for (const Point& corner :
           footprint_area(automaton().vehicle.footprint, measured).vertices_m) {
        ASSERT_TRUE(contains(maneuver.swept_area_m, corner, 1e-9));
      }
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST(SteeringLimit, OfThePapersTrimsTheTwoSharpestOfEachSideAreAtIt) {
  for (std::size_t number = 1; number <= 12; ++number) {
    EXPECT_EQ(is_at_steering_limit(automaton().trims[pi(number).index], automaton().vehicle,
                                   automaton().identified),
              number == 2 || number == 3 || number == 11 || number == 12)
        << number;
  }
}

}  // namespace
}  // namespace hlc::automaton
