#include "hlc_bridge/middleware/command_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace hlc::middleware::command_check_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Nanoseconds kMs = 1'000'000;
constexpr Nanoseconds kList = 400 * kMs + 1;
const std::vector<std::uint8_t> kIds{3};

TrajectoryCommand good_command() {
  TrajectoryCommand command;
  command.vehicle_id = 3;
  command.create_stamp = kList;
  command.valid_after_stamp = kList;
  for (Nanoseconds i = 0; i < 20; ++i) {
    command.points.push_back({kList - 50 * kMs + i * 50 * kMs, 1.0, 2.0, 0.5, 0.0});
  }
  return command;
}

CommandVerdict check(const TrajectoryCommand& command) {
  return check_command(command, kList + 5 * kMs, kList, kIds);
}

TEST(CommandCheck, GoodCommandHasNoFault) {
  EXPECT_TRUE(check(good_command()).forward);
  EXPECT_THAT(check(good_command()).faults, IsEmpty());
}

TEST(CommandCheck, CommandWithoutPointsIsGood) {
  TrajectoryCommand command = good_command();
  command.points.clear();
  EXPECT_TRUE(check(command).forward);
  EXPECT_THAT(check(command).faults, IsEmpty());
}

TEST(CommandCheck, CopyThatIsValidLaterIsGood) {
  TrajectoryCommand command = good_command();
  command.valid_after_stamp += 800 * kMs;
  EXPECT_THAT(check(command).faults, IsEmpty());
}

TEST(CommandCheck, ForeignVehicleIsKeptBack) {
  TrajectoryCommand command = good_command();
  command.vehicle_id = 4;
  EXPECT_FALSE(check(command).forward);
  EXPECT_THAT(check(command).faults, ElementsAre(CommandFault::kNotAssigned));
}

TEST(CommandCheck, NumbersThatAreNoneAreKeptBack) {
  for (double TrajectoryPoint::*field : {&TrajectoryPoint::x_m, &TrajectoryPoint::y_m,
                                         &TrajectoryPoint::vx_mps, &TrajectoryPoint::vy_mps}) {
    TrajectoryCommand command = good_command();
    command.points[7].*field = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(check(command).forward);
    EXPECT_THAT(check(command).faults, ElementsAre(CommandFault::kNotFinite));
  }
}

TEST(CommandCheck, RepeatedTimesAreKeptBack) {
  TrajectoryCommand command = good_command();
  command.points[5].t = command.points[4].t;
  EXPECT_FALSE(check(command).forward);
  EXPECT_THAT(check(command).faults, ElementsAre(CommandFault::kTimesNotIncreasing));
}

TEST(CommandCheck, FaultsThatTheLabOnlyLogsAreForwarded) {
  TrajectoryCommand late = good_command();
  late.create_stamp = kList - 1;
  EXPECT_TRUE(check(late).forward);
  EXPECT_THAT(check(late).faults, ElementsAre(CommandFault::kMissedPeriod));

  TrajectoryCommand early = good_command();
  early.create_stamp = kList + 6 * kMs;
  EXPECT_TRUE(check(early).forward);
  EXPECT_THAT(check(early).faults, ElementsAre(CommandFault::kFromTheFuture));

  TrajectoryCommand few = good_command();
  few.points.resize(2);
  EXPECT_TRUE(check(few).forward);
  EXPECT_THAT(check(few).faults, ElementsAre(CommandFault::kTooFewPoints));
}

TEST(CommandCheck, PointAtValidAfterIsNotBeforeIt) {
  TrajectoryCommand command = good_command();
  command.valid_after_stamp = command.points.front().t;
  EXPECT_THAT(check(command).faults, ElementsAre(CommandFault::kNoPointBefore));
  command.valid_after_stamp = command.points.back().t;
  EXPECT_THAT(check(command).faults, IsEmpty());
  command.valid_after_stamp = command.points.back().t + 1;
  EXPECT_THAT(check(command).faults, ElementsAre(CommandFault::kNoPointAfter));
}

}  // namespace
}  // namespace hlc::middleware::command_check_test
