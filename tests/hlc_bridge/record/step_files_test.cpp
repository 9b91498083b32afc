#include "hlc_bridge/record/step_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/common/csv.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::record {
namespace {

result::StepRecord row() {
  result::StepRecord row;
  row.step = 3;
  coordination::Report& report = row.record.report;
  report.vehicle = VehicleId{2};
  report.step = StepIndex{8};
  report.status = coordination::StepStatus::kFallback;
  report.reason = coordination::FallbackReason::kConflict;
  report.planned_pose = {1.5, 2.5, -0.5};
  report.planned_trim = TrimId{6};
  report.maneuver = "J2";
  report.subgraph = "B, at most 0.6 m/s";
  report.cost_m2 = 0.25;
  report.quality = coordination::PlanQuality::kBudget;
  report.gap_m2 = 0.125;
  report.bound_m2 = 0.0625;
  report.generated = 40;
  report.expanded = 4;
  report.level = 1;
  report.coupled = {VehicleId{1}, VehicleId{3}};
  report.missing = {VehicleId{3}};
  report.deviation_m = 0.001;
  report.waiting = {.vehicles = {VehicleId{3}, VehicleId{1}}, .since = StepIndex{7}};
  report.blocked_by = {VehicleId{1}, VehicleId{4}};
  report.arrived_since = StepIndex{6};
  row.record.planning_ns = 1'500'000;
  row.record.deadline_missed = true;
  row.record.late_ns = 250'000;
  row.record.response_ns = 31'500'000;
  row.driven = Pose{1.5, 2.25, -0.25};
  row.driven_speed_mps = 0.625;
  row.t_s = 0.75;
  return row;
}

TEST(StepFiles, RowHoldsEveryColumnOnce) {
  const std::vector<result::StepRecord> rows{row()};
  const std::string text = steps_csv(rows);
  EXPECT_EQ(
      text.substr(text.find('\n') + 1),
      "3,2,fallback,conflict,1.5,2.5,-0.5,7,1.5,2.25,-0.25,0.25,40,4,1,1;3,3,0.001,budget,0.125,J2,"
      "\"B, at most 0.6 m/s\",3;1,2,1;4,0.75,0.625,0.0625,1\n");
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  EXPECT_EQ(commas(text.substr(0, text.find('\n'))), commas(text.substr(text.find('\n') + 1)) - 1);
}

TEST(StepFiles, PoseAndSpeedThatWereNotRecordedAreEmpty) {
  std::vector<result::StepRecord> rows{row()};
  rows[0].driven.reset();
  rows[0].driven_speed_mps.reset();
  rows[0].record.report.bound_m2.reset();
  rows[0].record.report.arrived_since.reset();
  const std::string text = steps_csv(rows);
  EXPECT_NE(text.find(",7,,,,0.25,"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with(",0.75,,,\n")) << text;
}

TEST(StepFiles, WithoutAWaitItsColumnsAreEmpty) {
  std::vector<result::StepRecord> rows{row()};
  rows[0].record.report.waiting = {};
  EXPECT_TRUE(steps_csv(rows).ends_with("0.6 m/s\",,,1;4,0.75,0.625,0.0625,1\n"));
}

TEST(StepFiles, NothingOfTheClockIsInTheSteps) {
  std::vector<result::StepRecord> rows{row()};
  const std::string before = steps_csv(rows);
  rows[0].record.planning_ns = 99;
  rows[0].record.deadline_missed = false;
  rows[0].record.late_ns = 98;
  rows[0].record.report.step = StepIndex{100};  // k depends on when a run in real time began
  rows[0].record.report.waiting.since = StepIndex{99};
  rows[0].record.report.arrived_since = StepIndex{98};
  EXPECT_EQ(steps_csv(rows), before);
}

TEST(StepFiles, NamesOfAnyKindReadBack) {
  std::vector<result::StepRecord> rows(3, row());
  rows[0].record.report.maneuver = "\"";
  rows[1].record.report.maneuver = "a\nb,\r\n";
  rows[1].record.report.subgraph = "\"x\",\n4,2,planned";
  rows[2].record.report.subgraph = "";
  const test::TemporaryFolder folder;
  const std::string text = steps_csv(rows);
  test::put(folder / "steps.csv", text);
  const CsvTable table(folder / "steps.csv", text.substr(0, text.find('\n')));
  ASSERT_EQ(table.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(table.text(i, 20), rows[i].record.report.maneuver);
    EXPECT_EQ(table.text(i, 21), rows[i].record.report.subgraph);
  }
}

TEST(StepFiles, TimingHoldsTheClock) {
  const std::vector<result::StepRecord> rows{row()};
  EXPECT_EQ(timing_csv(rows),
            "step,id,planning_ms,deadline_missed,late_ms,response_ms\n3,2,1.5,1,0.25,31.5\n");
}

}  // namespace
}  // namespace hlc::record
