#include "hlc_bridge/result/run_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hlc::result::run_record_test {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

DrivenSample sample(Nanoseconds t, const Pose& pose) {
  DrivenSample sample;
  sample.t = t;
  sample.pose = pose;
  return sample;
}

ReportRecord report(std::uint8_t id, std::uint64_t k, double x_m = 0.0) {
  ReportRecord record;
  record.report.vehicle = VehicleId{id};
  record.report.step = StepIndex{k};
  record.report.planned_pose.x_m = x_m;
  return record;
}

TEST(DrivenPose, SampleOfThatTimeIsTakenAsItIs) {
  const Drive drive{sample(20 * kMs, {1, 2, 3}), sample(40 * kMs, {4, 5, 6})};
  EXPECT_EQ(driven_pose_at(drive, 20 * kMs), (Pose{1, 2, 3}));
  EXPECT_EQ(driven_pose_at(drive, 40 * kMs), (Pose{4, 5, 6}));
}

TEST(DrivenPose, IsLinearBetweenNeighboursAndTurnsTheShortWay) {
  constexpr double kPi = std::numbers::pi;
  const Drive drive{sample(20 * kMs, {1, 2, kPi - 0.1}), sample(40 * kMs, {2, 4, -kPi + 0.3})};
  const Pose pose = driven_pose_at(drive, 25 * kMs).value();
  EXPECT_DOUBLE_EQ(pose.x_m, 1.25);
  EXPECT_DOUBLE_EQ(pose.y_m, 2.5);
  EXPECT_NEAR(pose.heading_rad, kPi, 1e-12);
}

TEST(DrivenPose, IsUnknownOutsideAndInWideGaps) {
  const Drive drive{sample(20 * kMs, {}), sample(40 * kMs, {}), sample(160 * kMs, {})};
  EXPECT_FALSE(driven_pose_at(drive, 19 * kMs));
  EXPECT_FALSE(driven_pose_at(drive, 161 * kMs));
  EXPECT_FALSE(driven_pose_at(drive, 100 * kMs));
  EXPECT_FALSE(driven_pose_at({}, 20 * kMs));
}

TEST(DrivenSpeed, IsLinearBetweenNeighboursAndUnknownOutside) {
  Drive drive{sample(20 * kMs, {}), sample(40 * kMs, {})};
  drive[0].speed_mps = 0.5;
  drive[1].speed_mps = 0.75;
  EXPECT_EQ(driven_speed_mps_at(drive, 20 * kMs), 0.5);
  EXPECT_EQ(driven_speed_mps_at(drive, 40 * kMs), 0.75);
  EXPECT_NEAR(driven_speed_mps_at(drive, 25 * kMs).value(), 0.5625, 1e-12);
  EXPECT_FALSE(driven_speed_mps_at(drive, 19 * kMs));
  EXPECT_FALSE(driven_speed_mps_at(drive, 41 * kMs));
}

TEST(StepRecords, AreNumberedFromTheStartAndSortedByStepThenVehicle) {
  RunFacts facts;
  facts.period = 200 * kMs;
  facts.steps = 2;
  facts.first_step = 5;
  const std::vector<ReportRecord> reports{report(2, 6), report(2, 5), report(1, 5, 1.0),
                                          report(1, 4), report(1, 7), report(1, 5, 2.0)};
  Drives drives{{1, {sample(1000 * kMs, {7, 8, 9})}}};
  drives[1].front().speed_mps = 0.25;
  const std::vector<StepRecord> rows = step_records(reports, drives, facts);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].step, 0U);
  EXPECT_EQ(rows[0].record.report.vehicle.value, 1);
  EXPECT_EQ(rows[0].record.report.planned_pose.x_m, 2.0);  // the last report of a step counts
  EXPECT_EQ(rows[0].driven, (Pose{7, 8, 9}));
  EXPECT_EQ(rows[0].driven_speed_mps, 0.25);
  EXPECT_EQ(rows[0].t_s, 0.0);
  EXPECT_EQ(rows[1].step, 0U);
  EXPECT_EQ(rows[1].record.report.vehicle.value, 2);
  EXPECT_FALSE(rows[1].driven);
  EXPECT_FALSE(rows[1].driven_speed_mps);
  EXPECT_EQ(rows[2].step, 1U);
  EXPECT_EQ(rows[2].t_s, 0.2);
}

TEST(StepRecords, AreEmptyIfNobodyStarted) {
  RunFacts facts;
  facts.period = 200 * kMs;
  facts.steps = 2;
  const std::vector<ReportRecord> reports{report(1, 0)};
  EXPECT_TRUE(step_records(reports, {}, facts).empty());
}

}  // namespace
}  // namespace hlc::result::run_record_test
