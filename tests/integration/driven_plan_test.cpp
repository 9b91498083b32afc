#include "tests/integration/driven_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/integration/run_processes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

constexpr Nanoseconds kTick = 20'000'000;
constexpr Nanoseconds kSecond = 1'000'000'000;

/// Along x with 1 m/s for `seconds` from t = 0, then standing; points every 0.1 s until 3 s.
TrajectoryCommand straight(double seconds, Nanoseconds create_stamp) {
  TrajectoryCommand command{.vehicle_id = 1, .create_stamp = create_stamp};
  for (int i = 0; i <= 30; ++i) {
    const double t_s = 0.1 * i;
    const bool drives = t_s < seconds - 1e-9;
    command.points.push_back({.t = static_cast<Nanoseconds>(i) * kSecond / 10,
                              .x_m = std::min(t_s, seconds),
                              .vx_mps = drives ? 1.0 : 0.0});
  }
  return command;
}

/// Drives straight(seconds), and follows that command.
result::Drive drive(double seconds, Nanoseconds create_stamp, Nanoseconds end = 3 * kSecond) {
  result::Drive samples;
  for (Nanoseconds t = 0; t <= end; t += kTick) {
    const double t_s = 1e-9 * static_cast<double>(t);
    samples.push_back({.t = t,
                       .pose = {std::min(t_s, seconds), 0.0, 0.0},
                       .speed_mps = t_s < seconds ? 1.0 : 0.0,
                       .command_create = create_stamp});
  }
  return samples;
}

Commands commands_of(const std::vector<TrajectoryCommand>& list) {
  Commands commands;
  for (const TrajectoryCommand& command : list) {
    commands[{command.vehicle_id, command.create_stamp}] = command;
  }
  return commands;
}

TEST(DrivenPlan, WhoFollowsItsPlanIsNowhereFarFromIt) {
  const auto farthest_m =
      farthest_from_plan_m(drive(1.5, 7), commands_of({straight(1.5, 7)}), 1, 0, kForever);
  ASSERT_TRUE(farthest_m);
  EXPECT_LT(*farthest_m, 0.02);  // it brakes within a point's interval, not at once
}

TEST(DrivenPlan, WhoDrivesANewerPlanShowsAgainstTheOneItFollowedAtTheBegin) {
  result::Drive driven = drive(2.0, 7);
  for (result::DrivenSample& sample : driven) {
    if (sample.t > kSecond) sample.command_create = 8;
  }
  const Commands commands = commands_of({straight(1.5, 7), straight(2.0, 8)});
  EXPECT_NEAR(farthest_from_plan_m(driven, commands, 1, kSecond / 2, kForever).value(), 0.5, 0.02);
  EXPECT_LT(farthest_from_plan_m(driven, commands, 1, kSecond / 2, kSecond).value(), 0.02);
  EXPECT_LT(farthest_from_plan_m(driven, commands, 1, kSecond + kTick, kForever).value(), 0.02);
}

TEST(DrivenPlan, NothingIsSaidOfAPlanThatWasNotRecordedOrOfNoTime) {
  const Commands commands = commands_of({straight(1.5, 7)});
  EXPECT_FALSE(farthest_from_plan_m(drive(1.5, 0), commands, 1, 0, kForever));
  EXPECT_FALSE(farthest_from_plan_m(drive(1.5, 7), commands, 2, 0, kForever));
  EXPECT_FALSE(farthest_from_plan_m(drive(1.5, 7), commands, 1, 9 * kSecond, kForever));
}

TEST(DrivenPlan, StandingCountsFromTheLastTimeThatTheVehicleMoved) {
  result::Drive driven = drive(1.0, 7);
  EXPECT_EQ(standing_since(driven, kForever), kSecond);
  EXPECT_EQ(standing_since(driven, kSecond / 2), std::nullopt);
  driven[100].speed_mps = -0.3;  // at 2 s
  EXPECT_EQ(standing_since(driven, kForever), 2 * kSecond + kTick);
}

TEST(RecordedCommands, AreReadAsTheyWereWrittenWithoutAnUnfinishedLastLine) {
  const TemporaryFolder folder;
  const TrajectoryCommand first = straight(1.5, 7);
  std::FILE* file = std::fopen((folder / "commands").c_str(), "w");
  ASSERT_NE(file, nullptr);
  append(first, *file);
  TrajectoryCommand copy = first;
  copy.valid_after_stamp = 800;
  append(copy, *file);
  append({.vehicle_id = 2, .create_stamp = 9, .valid_after_stamp = 9}, *file);
  std::fputs("3 11 11 5 0.1", file);
  std::fclose(file);
  const Commands commands = read_commands(folder / "commands");
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_TRUE(commands.at({2, 9}).points.empty());
  EXPECT_EQ(commands.at({1, 7}).valid_after_stamp, 800U);
  EXPECT_TRUE(is_newest_sent_whole(commands, 1));
  EXPECT_FALSE(is_newest_sent_whole(commands, 2));
  EXPECT_FALSE(is_newest_sent_whole(commands, 3));
  const std::vector<TrajectoryPoint>& points = commands.at({1, 7}).points;
  ASSERT_EQ(points.size(), first.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].t, first.points[i].t);
    EXPECT_EQ(points[i].x_m, first.points[i].x_m);
    EXPECT_EQ(points[i].vx_mps, first.points[i].vx_mps);
  }
}

TEST(ReportsSoFar, AreNoneAsLongAsTheFileHasNoHeading) {
  const TemporaryFolder folder;
  EXPECT_TRUE(reports_so_far(folder.path()).empty());
  put(folder / "reports.csv", "");
  EXPECT_TRUE(reports_so_far(folder.path()).empty());
}

}  // namespace
}  // namespace hlc::test
