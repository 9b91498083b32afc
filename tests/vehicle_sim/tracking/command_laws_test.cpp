#include "vehicle_sim/tracking/command_laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hlc::tracking::command_laws_test {
namespace {

const vehicle::IdentifiedVehicle kVehicle;
constexpr int kTicksPerSecond = 50;

/// A circle around (0, radius), from the origin; to the left if the radius is positive.
PathTrackingCommand circle(double radius_m, double speed_mps) {
  PathTrackingCommand command{.speed_mps = speed_mps};
  constexpr int kPoints = 72;
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % kPoints) / kPoints;
    command.path.push_back({.pose = {.x_m = std::abs(radius_m) * std::sin(angle),
                                     .y_m = radius_m * (1.0 - std::cos(angle)),
                                     .heading_rad = std::copysign(angle, radius_m)},
                            .s_m = std::abs(radius_m) * angle});
  }
  return command;
}

PathTrackingCommand straight(double length_m, double y_m = 0.0) {
  return {
      .path = {{.pose = {.y_m = y_m}}, {.pose = {.x_m = length_m, .y_m = y_m}, .s_m = length_m}},
      .speed_mps = 0.5};
}

TEST(DirectInput, IsWhatWasToldWithinTheActuatorsRange) {
  EXPECT_EQ(direct_input({.motor_throttle = 0.3, .steering_servo = -0.4}),
            (vehicle::ActuatorInput{.throttle = 0.3, .steering = -0.4}));
  EXPECT_EQ(direct_input({.motor_throttle = -7.0, .steering_servo = 2.0}),
            (vehicle::ActuatorInput{.throttle = -1.0, .steering = 1.0}));
}

TEST(SteeringForCurvature, IsTheLabsFigure) {
  EXPECT_DOUBLE_EQ(steering_for_curvature(2.0), 0.483714);
  EXPECT_DOUBLE_EQ(steering_for_curvature(-1.0), -0.241857);
  EXPECT_EQ(steering_for_curvature(50.0), 1.0);
  EXPECT_EQ(steering_for_curvature(-50.0), -1.0);
}

TEST(SpeedControl, ReachesTheSpeedOfTheIdentifiedVehicleForwardAndBackward) {
  for (const double wanted_mps : {0.3, 0.8, 1.2, -0.3}) {
    SpeedControl control;
    vehicle::VehicleMotion motion;
    for (int tick = 0; tick < 5 * kTicksPerSecond; ++tick) {
      motion = vehicle::stepped(motion, {.throttle = control.tick(wanted_mps, motion.speed_mps)},
                                kVehicle);
    }
    EXPECT_NEAR(motion.speed_mps, wanted_mps, 0.02) << wanted_mps;
  }
}

TEST(SpeedControl, DoesNotRememberMoreThanHalfTheThrottle) {
  SpeedControl control;
  for (int tick = 0; tick < 1000; ++tick) static_cast<void>(control.tick(1.0, 0.0));
  // Feed forward and proportional part of standstill, wanted and measured, are 0.
  EXPECT_DOUBLE_EQ(control.tick(0.0, 0.0), 0.5);
  control.reset();
  EXPECT_EQ(control.tick(0.0, 0.0), 0.0);
}

TEST(SteeringForPath, FollowsACircleOnEitherSideForManyRounds) {
  for (const double radius_m : {1.0, -1.0, 0.5, -0.5}) {
    const PathTrackingCommand command = circle(radius_m, 0.8);
    SpeedControl control;
    vehicle::VehicleMotion motion{.pose = {.x_m = 0.0, .y_m = -0.05, .heading_rad = 0.1}};
    double largest_m = 0.0;
    for (int tick = 0; tick < 60 * kTicksPerSecond; ++tick) {
      const auto steering = steering_for_path(command, motion);
      ASSERT_TRUE(steering) << tick;
      motion = vehicle::stepped(
          motion,
          {.throttle = control.tick(command.speed_mps, motion.speed_mps), .steering = *steering},
          kVehicle);
      const double distance_m =
          std::abs((motion.pose.position_m() - Point(0.0, radius_m)).norm() - std::abs(radius_m));
      if (tick > 5 * kTicksPerSecond) largest_m = std::max(largest_m, distance_m);
    }
    EXPECT_LT(largest_m, 0.05) << radius_m;
  }
}

TEST(SteeringForPath, SteersTowardsAPathAtItsSide) {
  const vehicle::VehicleMotion along_x{.pose = {.x_m = 1.0}, .speed_mps = 0.5};
  EXPECT_GT(*steering_for_path(straight(3.0, 0.2), along_x), 0.1);
  EXPECT_LT(*steering_for_path(straight(3.0, -0.2), along_x), -0.1);
  EXPECT_DOUBLE_EQ(*steering_for_path(straight(3.0), along_x), 0.0);
}

TEST(SteeringForPath, HasNothingToFollowOnAnEmptyPathOrBehindTheEndOfAnOpenOne) {
  EXPECT_FALSE(steering_for_path({}, {}));
  EXPECT_FALSE(steering_for_path({.path = {{.pose = {.x_m = 1.0}}}}, {}));
  EXPECT_FALSE(steering_for_path(straight(0.0), {}));
  EXPECT_TRUE(steering_for_path(straight(1.0), {.pose = {.x_m = 0.9}}));
  EXPECT_FALSE(steering_for_path(straight(1.0), {.pose = {.x_m = 0.95}}));  // the axle is past it
  EXPECT_TRUE(steering_for_path(circle(1.0, 0.8), {.pose = {.x_m = -0.05}}));
}

}  // namespace
}  // namespace hlc::tracking::command_laws_test
