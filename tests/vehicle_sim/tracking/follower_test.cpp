#include "vehicle_sim/tracking/follower.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/num_seeds.hpp"
#include "vehicle_sim/tracking/trajectory.hpp"

namespace hlc::tracking::follower_test {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const vehicle::IdentifiedVehicle kVehicle;

Follower follower(const FollowerGains& gains = {}) { return Follower(gains, kVehicle); }

/// Along x from x(0) = x_m, from t = 0 to 5 s.
TrajectoryCommand straight(double speed_mps, double x_m = 0.0) {
  TrajectoryCommand command;
  for (Nanoseconds t = 0; t <= 5'000 * kMillisecond; t += 50 * kMillisecond) {
    command.points.push_back(
        {.t = t, .x_m = x_m + speed_mps * 1e-9 * static_cast<double>(t), .vx_mps = speed_mps});
  }
  return command;
}

/// A circle of curvature kappa through the origin with course 0 at t = 0, from t = 0 to 10 s.
TrajectoryCommand circle(double speed_mps, double kappa_per_m) {
  TrajectoryCommand command;
  for (Nanoseconds t = 0; t <= 10'000 * kMillisecond; t += 50 * kMillisecond) {
    const double angle = kappa_per_m * speed_mps * 1e-9 * static_cast<double>(t);
    command.points.push_back({.t = t,
                              .x_m = std::sin(angle) / kappa_per_m,
                              .y_m = (1.0 - std::cos(angle)) / kappa_per_m,
                              .vx_mps = speed_mps * std::cos(angle),
                              .vy_mps = speed_mps * std::sin(angle)});
  }
  return command;
}

TEST(Follower, WithoutCommandItStops) {
  const auto [input, status] =
      follower().tick(0, {.pose = {.x_m = 1.0}, .speed_mps = 0.6}, nullptr);
  EXPECT_EQ(status, FollowerStatus::kNoCommand);
  EXPECT_EQ(input, vehicle::stop_input(0.6));
}

TEST(Follower, WithAnEmptyCommandItStops) {
  const TrajectoryCommand empty;
  const auto [input, status] = follower().tick(0, {.speed_mps = 0.6}, &empty);
  EXPECT_EQ(status, FollowerStatus::kNotFollowable);
  EXPECT_EQ(input, vehicle::stop_input(0.6));
}

TEST(Follower, WithACommandThatEndsTooEarlyItStops) {
  const TrajectoryCommand command = straight(0.5);
  vehicle::VehicleMotion motion{.pose = {.x_m = 0.5 * 4.66}, .speed_mps = 0.5};
  EXPECT_EQ(follower().tick(4'640 * kMillisecond, motion, &command).status,
            FollowerStatus::kFollowing);
  EXPECT_EQ(follower().tick(4'660 * kMillisecond, motion, &command).status,
            FollowerStatus::kNotFollowable);
}

TEST(Follower, FarFromTheReferenceItStops) {
  const TrajectoryCommand command = straight(0.0);
  EXPECT_EQ(follower().tick(0, {.pose = {.y_m = 0.29}}, &command).status,
            FollowerStatus::kFollowing);
  const auto [input, status] =
      follower().tick(0, {.pose = {.y_m = 0.31}, .speed_mps = 0.1}, &command);
  EXPECT_EQ(status, FollowerStatus::kTooFar);
  EXPECT_EQ(input, vehicle::stop_input(0.1));
}

TEST(Follower, EstimateThatIsNotFiniteGivesNoThrottle) {
  const TrajectoryCommand command = straight(0.5);
  for (const vehicle::VehicleMotion& bad : {vehicle::VehicleMotion{.pose = {.x_m = kNan}},
                                            vehicle::VehicleMotion{.pose = {.y_m = kNan}},
                                            vehicle::VehicleMotion{.pose = {.heading_rad = kNan}},
                                            vehicle::VehicleMotion{.speed_mps = kNan}}) {
    const auto [input, status] = follower().tick(0, bad, &command);
    EXPECT_EQ(status, FollowerStatus::kNoEstimate);
    EXPECT_EQ(input, vehicle::ActuatorInput{});
  }
}

TEST(Follower, ZeroGainsNeverDrive) {
  Follower zero = follower(scaled({}, 0.0));
  const TrajectoryCommand command = straight(0.5);
  for (Nanoseconds t = 0; t < 400 * kMillisecond; t += kVehiclePeriod) {
    const auto [input, status] = zero.tick(t, {}, &command);
    EXPECT_EQ(status, FollowerStatus::kFollowing);
    EXPECT_EQ(input.throttle, 0.0);
  }
}

TEST(Follower, ScaledMultipliesEveryGain) {
  const FollowerGains gains =
      scaled({.feed_forward = 1.0, .longitudinal_per_s = 2.0, .lateral_per_s = 3.0}, 0.5);
  EXPECT_EQ(gains.feed_forward, 0.5);
  EXPECT_EQ(gains.longitudinal_per_s, 1.0);
  EXPECT_EQ(gains.lateral_per_s, 1.5);
}

/// Drives the model without noise; the last inputs given.
struct Driven {
  vehicle::VehicleMotion motion;
  vehicle::ActuatorInput input;
};
Driven drive(Follower& by, vehicle::VehicleMotion motion, const TrajectoryCommand& command,
             Nanoseconds until_ms) {
  Driven driven{.motion = motion, .input = {}};
  for (Nanoseconds t = 0; t < until_ms * kMillisecond; t += kVehiclePeriod) {
    driven.input = by.tick(t, driven.motion, &command).input;
    driven.motion = vehicle::stepped(driven.motion, by.acted(), kVehicle);
  }
  return driven;
}

TEST(Follower, OnASteadyCircleItGivesTheSteadyInputs) {
  for (const double kappa_per_m : {1.0, -1.0, 3.36, -3.36}) {
    Follower one = follower();
    const Driven end = drive(one, {}, circle(0.5, kappa_per_m), 8'000);
    const double delta = vehicle::steady_steering(kappa_per_m, kVehicle);
    EXPECT_NEAR(end.input.steering + kVehicle.steering_offset, delta, 0.005) << kappa_per_m;
    const double speed_mps = 0.5 / vehicle::path_speed_ratio(end.input.steering, kVehicle);
    EXPECT_NEAR(end.input.throttle, vehicle::throttle_for_acceleration(0.0, speed_mps, kVehicle),
                0.005);
  }
}

TEST(Follower, ReturnsToTheReferenceFromBesideIt) {
  for (const double offset_m : {0.05, -0.05, 0.15, -0.15}) {
    for (const double yaw_rad : {0.0, 0.3, -0.3}) {
      Follower one = follower();
      const vehicle::VehicleMotion start{.pose = {.y_m = offset_m, .heading_rad = yaw_rad}};
      const Driven end = drive(one, start, straight(0.8), 3'000);
      EXPECT_NEAR(end.motion.pose.y_m, 0.0, 0.002) << offset_m << ' ' << yaw_rad;
      EXPECT_NEAR(end.motion.pose.x_m, 0.8 * 3.0, 0.002) << offset_m << ' ' << yaw_rad;
    }
  }
}

TEST(Follower, WhereTheReferenceStandsItNeitherCreepsNorGoesBack) {
  for (const double ahead_m : {0.004, 0.0, -0.004, -0.1}) {  // of the vehicle
    Follower one = follower();
    const Driven end = drive(one, {}, straight(0.0, ahead_m), 4'000);
    EXPECT_EQ(end.motion, vehicle::VehicleMotion{}) << ahead_m;
  }
}

TEST(Follower, AheadOfASlowReferenceItWaitsForIt) {
  Follower one = follower();
  const TrajectoryCommand command = straight(0.1);
  vehicle::VehicleMotion motion{.pose = {.x_m = 0.2}};
  for (Nanoseconds t = 0; t < 4'000 * kMillisecond; t += kVehiclePeriod) {
    static_cast<void>(one.tick(t, motion, &command));
    motion = vehicle::stepped(motion, one.acted(), kVehicle);
    ASSERT_GE(motion.speed_mps, -1e-9) << t;
  }
  EXPECT_NEAR(motion.pose.x_m, 0.4, 0.002);
}

TEST(Follower, ClosesAGapToAStandingReferenceAhead) {
  Follower one = follower();
  const Driven end = drive(one, {}, straight(0.0, 0.1), 4'000);
  EXPECT_NEAR(end.motion.pose.x_m, 0.1, Follower::kStandingTolerance_m + 0.001);
  EXPECT_NEAR(end.motion.speed_mps, 0.0, 1e-6);
}

TEST(Follower, TrajectoryThatBeginsJustBeforeTheFirstLookIsFollowed) {
  TrajectoryCommand command = straight(0.5);
  for (TrajectoryPoint& point : command.points) {
    point.t += 109 * kMillisecond;
  }
  const auto [input, status] = follower().tick(0, {}, &command);
  EXPECT_EQ(status, FollowerStatus::kFollowing);
  EXPECT_GT(input.throttle, 0.0);
}

TEST(Follower, InputsAreAlwaysFiniteAndWithinTheActuators) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(2'000); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const double size = std::pow(10.0, 4.0 * unit(random) - 2.0);
    TrajectoryCommand command;
    for (Nanoseconds t = 0; t <= 1'000 * kMillisecond; t += (1 + random() % 300) * kMillisecond) {
      command.points.push_back({.t = t,
                                .x_m = size * unit(random),
                                .y_m = size * unit(random),
                                .vx_mps = size * unit(random),
                                .vy_mps = size * unit(random)});
    }
    Follower one = follower();
    vehicle::VehicleMotion motion{.pose = {.x_m = size * unit(random),
                                           .y_m = size * unit(random),
                                           .heading_rad = 4.0 * unit(random)},
                                  .speed_mps = 4.0 * unit(random)};
    for (Nanoseconds t = 0; t < 600 * kMillisecond; t += kVehiclePeriod) {
      const vehicle::ActuatorInput input = one.tick(t, motion, &command).input;
      ASSERT_TRUE(std::abs(input.throttle) <= 1.0 && std::abs(input.steering) <= 1.0);
      motion = vehicle::stepped(motion, one.acted(), kVehicle);
    }
  }
}

}  // namespace
}  // namespace hlc::tracking::follower_test
