#include "hlc_bridge/record/step_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hlc {
namespace {

StepRecord row() {
  StepRecord row;
  row.step = 3;
  Report& report = row.record.report;
  report.vehicle = VehicleId{2};
  report.step = StepIndex{8};
  report.status = StepStatus::kFallback;
  report.reason = FallbackReason::kConflict;
  report.planned_pose = {1.5, 2.5, -0.5};
  report.planned_trim = TrimId{6};
  report.cost_m2 = 0.25;
  report.quality = PlanQuality::kBudget;
  report.gap_m2 = 0.125;
  report.generated = 40;
  report.expanded = 4;
  report.level = 1;
  report.coupled = {VehicleId{1}, VehicleId{3}};
  report.missing = {VehicleId{3}};
  report.deviation_m = 0.001;
  row.record.planning_ns = 1'500'000;
  row.record.deadline_missed = true;
  row.record.late_ns = 250'000;
  row.driven = Pose{1.5, 2.25, -0.25};
  return row;
}

TEST(StepFiles, RowHoldsEveryColumnOnce) {
  const std::vector<StepRecord> rows{row()};
  const std::string text = steps_csv(rows);
  EXPECT_EQ(
      text.substr(text.find('\n') + 1),
      "3,2,fallback,conflict,1.5,2.5,-0.5,7,1.5,2.25,-0.25,0.25,40,4,1,1;3,3,0.001,budget,0.125\n");
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  EXPECT_EQ(commas(text.substr(0, text.find('\n'))), commas(text.substr(text.find('\n') + 1)));
}

TEST(StepFiles, PoseThatWasNotRecordedIsEmpty) {
  std::vector<StepRecord> rows{row()};
  rows[0].driven.reset();
  const std::string text = steps_csv(rows);
  EXPECT_NE(text.find(",7,,,,0.25,"), std::string::npos) << text;
}

TEST(StepFiles, NothingOfTheClockIsInTheSteps) {
  std::vector<StepRecord> rows{row()};
  const std::string before = steps_csv(rows);
  rows[0].record.planning_ns = 99;
  rows[0].record.deadline_missed = false;
  rows[0].record.late_ns = 98;
  rows[0].record.report.step = StepIndex{100};  // k depends on when a run in real time began
  EXPECT_EQ(steps_csv(rows), before);
}

TEST(StepFiles, TimingHoldsTheClock) {
  const std::vector<StepRecord> rows{row()};
  EXPECT_EQ(timing_csv(rows), "step,id,planning_ms,deadline_missed,late_ms\n3,2,1.5,1,0.25\n");
}

}  // namespace
}  // namespace hlc
