#include "vehicle_sim/tracking/lab_follower.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hlc::tracking::lab_follower_test {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

/// Along x from the origin, from t = 0 to 5 s.
TrajectoryCommand straight(double speed_mps) {
  TrajectoryCommand command;
  for (Nanoseconds t = 0; t <= 5'000 * kMillisecond; t += 50 * kMillisecond) {
    command.points.push_back(
        {.t = t, .x_m = speed_mps * 1e-9 * static_cast<double>(t), .vx_mps = speed_mps});
  }
  return command;
}

LabFollower follower() { return LabFollower(vehicle::IdentifiedVehicle{}); }

TEST(LabFollower, WithoutAFollowableCommandItStops) {
  const vehicle::VehicleMotion moving{.speed_mps = 0.6};
  const TrajectoryCommand empty;
  for (const TrajectoryCommand* command :
       {static_cast<const TrajectoryCommand*>(nullptr), &empty}) {
    const auto [input, status] = follower().decide(0, moving, command);
    EXPECT_EQ(status,
              command == nullptr ? FollowerStatus::kNoCommand : FollowerStatus::kNotFollowable);
    EXPECT_EQ(input, vehicle::stop_input(0.6));
  }
}

TEST(LabFollower, FarFromItsCommandItStops) {
  const TrajectoryCommand command = straight(0.5);
  const vehicle::VehicleMotion beside{.pose = {.y_m = 0.4}, .speed_mps = 0.5};
  const auto [input, status] = follower().decide(0, beside, &command);
  EXPECT_EQ(status, FollowerStatus::kTooFar);
  EXPECT_EQ(input, vehicle::stop_input(0.5));
}

TEST(LabFollower, WithoutAnEstimateItGivesNoInput) {
  const TrajectoryCommand command = straight(0.5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const vehicle::VehicleMotion& unknown :
       {vehicle::VehicleMotion{.pose = {.x_m = nan}}, vehicle::VehicleMotion{.speed_mps = nan}}) {
    const auto [input, status] = follower().decide(0, unknown, &command);
    EXPECT_EQ(status, FollowerStatus::kNoEstimate);
    EXPECT_EQ(input, vehicle::ActuatorInput{});
  }
}

TEST(LabFollower, InputsFromAnySourceAreUnderWay) {
  const TrajectoryCommand command = straight(0.5);
  LabFollower idle = follower();
  LabFollower thrown = follower();
  for (const double throttle : {1.0, 1.0, 0.0}) {  // the last one is what changes cost from
    idle.give({});
    thrown.give({.throttle = throttle, .steering = 0.0});
  }
  const vehicle::VehicleMotion moving{.speed_mps = 0.5};
  EXPECT_LT(thrown.decide(0, moving, &command).input.throttle,
            idle.decide(0, moving, &command).input.throttle);
}

}  // namespace
}  // namespace hlc::tracking::lab_follower_test
