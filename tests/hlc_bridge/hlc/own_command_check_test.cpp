#include "hlc_bridge/hlc/own_command_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "hlc_bridge/hlc/command.hpp"
#include "tests/planner/vehicle/cpm_lab.hpp"

namespace hlc::high_level_controller::own_command_check_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr Nanoseconds kMs = 1'000'000;
constexpr Nanoseconds kList = 10'000 * kMs + 1;

/// Drives 0.2 s with 0.4 m/s, slows down in 0.2 s and stands.
TrajectoryCommand good_command() {
  TrajectoryCommand command{
      .vehicle_id = 3, .create_stamp = kList, .valid_after_stamp = kList, .points = {}};
  double x_m = 1.0;
  double vx_mps = 0.4;
  for (Nanoseconds i = 0; i < 47; ++i) {
    const double next_mps = i < 5 ? 0.4 : std::max(0.0, vx_mps - 0.1);
    if (i > 0) x_m += 0.05 * 0.5 * (vx_mps + next_mps);
    vx_mps = next_mps;
    command.points.push_back({kList - 1 - 50 * kMs + i * 50 * kMs, x_m, 2.0, vx_mps, 0.0});
  }
  return command;
}

TEST(OwnCommandCheck, AGoodCommandAndItsCopyHaveNoFault) {
  EXPECT_EQ(validate_own_command(good_command(), vehicle::kCpmLab), "");
  EXPECT_EQ(validate_own_command(copy_for_later(good_command()), vehicle::kCpmLab), "");
}

TEST(OwnCommandCheck, ACommandWithoutPointsTellsToStandAndIsGood) {
  EXPECT_EQ(
      validate_own_command({.vehicle_id = 3, .create_stamp = kList, .valid_after_stamp = kList},
                           vehicle::kCpmLab),
      "");
}

TEST(OwnCommandCheck, NumbersThatAreNoneAreFoundWithoutALabToo) {
  TrajectoryCommand command = good_command();
  command.points[9].vy_mps = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(validate_own_command(command, std::nullopt), HasSubstr("not a finite number"));
}

TEST(OwnCommandCheck, TimesThatDoNotIncreaseAreFound) {
  TrajectoryCommand command = good_command();
  command.points[9].t = command.points[8].t;
  EXPECT_THAT(validate_own_command(command, std::nullopt), StartsWith("times of the points"));
  command.points[9].t = command.points[0].t - 1;
  EXPECT_THAT(validate_own_command(command, std::nullopt), StartsWith("times of the points"));
}

TEST(OwnCommandCheck, AnEndThatDrivesOnIsFound) {
  TrajectoryCommand command = good_command();
  command.points.back().vx_mps = 0.1;
  EXPECT_THAT(validate_own_command(command, std::nullopt),
              StartsWith("speed at the end = 0.1 m/s"));
}

TEST(OwnCommandCheck, AFirstPointThatIsNotBeforeValidAfterIsFound) {
  TrajectoryCommand command = good_command();
  command.valid_after_stamp = command.points.front().t;
  EXPECT_EQ(validate_own_command(command, vehicle::kCpmLab),
            "the first point is 0 s after valid_after, must be before it");
}

// now + period + 360 ms would do for the lab's vehicle if no command were ever lost.
TEST(OwnCommandCheck, ACommandThatEndsBeforeItExpiresIsFound) {
  TrajectoryCommand command = good_command();
  while (command.points.back().t >= kList + 1'360 * kMs) command.points.pop_back();
  EXPECT_THAT(validate_own_command(command, vehicle::kCpmLab), HasSubstr("must be >= 1.36 s"));
  TrajectoryCommand later = good_command();
  later.valid_after_stamp += 900 * kMs;
  EXPECT_THAT(validate_own_command(later, vehicle::kCpmLab), HasSubstr("must be >= 1.36 s"));
}

TEST(OwnCommandCheck, WhatTheLabsVehicleCannotFollowIsFoundWithAPlace) {
  TrajectoryCommand outside = good_command();
  for (TrajectoryPoint& point : outside.points) point.x_m += 3.45;
  EXPECT_THAT(validate_own_command(outside, vehicle::kCpmLab), StartsWith("coordinate = 4.5"));
  EXPECT_EQ(validate_own_command(outside, std::nullopt), "") << "no area is given";

  TrajectoryCommand aside = good_command();
  aside.points[2].y_m += 0.003;
  EXPECT_THAT(validate_own_command(aside, vehicle::kCpmLab), HasSubstr(" s after the first point"));
}

TEST(OwnCommandCheck, WhatWasGoodStaysGoodHoweverOftenItIsSaidAgain) {
  TrajectoryCommand command = good_command();
  for (Nanoseconds k = 1; k < 20; ++k) {
    const Nanoseconds t_now = kList + k * 200 * kMs;
    command = republished(command, t_now);
    EXPECT_EQ(command.create_stamp, t_now);
    EXPECT_EQ(command.valid_after_stamp, t_now);
    EXPECT_EQ(validate_own_command(command, vehicle::kCpmLab), "") << k;
    EXPECT_EQ(validate_own_command(copy_for_later(command), vehicle::kCpmLab), "") << k;
    EXPECT_EQ(command.points.back().x_m, good_command().points.back().x_m);
  }
}

}  // namespace
}  // namespace hlc::high_level_controller::own_command_check_test
