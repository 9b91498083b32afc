#include "hlc_bridge/result/run_comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::result {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr Nanoseconds kSecond = 1'000'000'000;

/// Vehicles 1 ... `count` that drive 3 m in 2 s along x, after 5 m before the run.
ComparedRun driven_run(std::uint8_t count) {
  ComparedRun run;
  run.name = "run";
  run.summary.description.scenario = "scenario";
  run.summary.description.profile = "default";
  run.summary.description.subgraph = "B";
  run.summary.description.step_s = 1.0;
  run.summary.steps = 2;
  run.summary.trace_sha256 = std::string(64, 'a');
  run.facts.period = kSecond;
  run.facts.first_step = 5;
  run.facts.steps = 2;
  for (std::uint8_t id = 1; id <= count; ++id) {
    run.facts.vehicle_ids.push_back(id);
    run.summary.vehicles.push_back({.id = VehicleId{id}, .name = "car"});
    run.drives[id] = {{.t = 4 * kSecond, .pose = {-5.0, 0.0, 0.0}},
                      {.t = 5 * kSecond, .pose = {0.0, 0.0, 0.0}},
                      {.t = 6 * kSecond, .pose = {1.0, 0.0, 0.0}},
                      {.t = 7 * kSecond, .pose = {3.0, 0.0, 0.0}}};
    for (std::uint64_t step = 0; step < 2; ++step) {
      StepRecord row{.step = step, .record = {}, .driven = Pose{}};
      row.record.report.vehicle = VehicleId{id};
      run.rows.push_back(row);
    }
  }
  return run;
}

TEST(RunComparison, OfEqualRunsHasOneRowPerVehicle) {
  const RunComparison comparison = compare(driven_run(2), driven_run(2), {});
  EXPECT_FALSE(comparison.first);
  EXPECT_THAT(
      comparison_lines(comparison),
      ElementsAre("first run: run (scenario, profile default, subgraph B, 2 steps, 2 "
                  "vehicles)",
                  "second run: run (scenario, profile default, subgraph B, 2 steps, 2 "
                  "vehicles)",
                  "the runs are equal: 2 steps, 2 vehicles, trace_sha256 " + std::string(64, 'a')));
  EXPECT_THAT(vehicle_table(comparison).rows,
              ElementsAre(ElementsAre("1 car", "both", "-", "3.000", "1.500", "-", "-", "0", "-"),
                          ElementsAre("2 car", "both", "-", "3.000", "1.500", "-", "-", "0", "-")));
}

TEST(RunComparison, RunsOfWhichOneWasNotDrivenToItsEndDiffer) {
  ComparedRun interrupted = driven_run(2);
  interrupted.facts.exit_code = kExitDied;
  interrupted.facts.reason = "middleware_1 died";
  const RunComparison comparison = compare(driven_run(2), interrupted, {});
  EXPECT_FALSE(comparison.are_equal());
  EXPECT_EQ(comparison_lines(comparison).back(),
            "the runs differ, though not in their steps: exit code 0 and 4: middleware_1 died");
  ComparedRun stuck = driven_run(2);
  stuck.facts.exit_code = kExitStuck;
  EXPECT_TRUE(compare(driven_run(2), stuck, {}).are_equal());
}

TEST(RunComparison, RunsThatDifferBetweenTwoStepsDiffer) {
  ComparedRun other = driven_run(2);
  other.summary.trace_sha256 = std::string(64, 'b');
  const RunComparison comparison = compare(driven_run(2), other, {});
  EXPECT_FALSE(comparison.are_equal());
  EXPECT_THAT(comparison_lines(comparison).back(), HasSubstr("drove between two of them"));
}

TEST(RunComparison, RunsWithoutAnyStepAreRefused) {
  ComparedRun none = driven_run(1);
  none.rows.clear();
  const auto compare_them = [&] { static_cast<void>(compare(none, none, {})); };
  EXPECT_THAT(compare_them, testing::ThrowsMessage<std::invalid_argument>(
                                "run and run: no vehicle started, must have steps to compare"));
}

TEST(RunComparison, NamesStepTimeAndVehicleOfTheFirstDifference) {
  ComparedRun other = driven_run(2);
  other.rows[1].record.report.level = 1;  // vehicle 1, step 1
  other.incomplete = {"reports.csv ends early"};
  const RunComparison comparison = compare(driven_run(2), std::move(other), {"seed: 1 and 2"});
  const std::vector<std::string> lines = comparison_lines(comparison);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[2], "started differently: seed: 1 and 2");
  EXPECT_EQ(lines[3], "run: reports.csv ends early");
  EXPECT_EQ(lines[4], "all cars drive the same way");
  EXPECT_EQ(lines[5],
            "the runs differ at step 1 (1.0 s), vehicle 1: messages: computation level 0 and 1");
}

/// Two runs; in the second vehicle 1 plans on another level in step 1, and the last row's car is
/// beside its place in the first.
RunComparison apart_by(double apart_m, double turned_rad = 0.0) {
  ComparedRun other = driven_run(2);
  other.rows[1].record.report.level = 1;
  other.rows.back().driven = Pose{0.0, apart_m, turned_rad};
  return compare(driven_run(2), std::move(other), {});
}

std::string way_line(const RunComparison& comparison) {
  const std::vector<std::string> lines = comparison_lines(comparison);
  return lines.at(lines.size() - 2);
}

TEST(RunComparison, NamesTheFirstCarToDriveElsewhere) {
  const RunComparison comparison = apart_by(0.002);
  ASSERT_TRUE(comparison.ways.first);
  EXPECT_EQ(comparison.ways.first->step, comparison.a.rows.back().step);
  EXPECT_EQ(comparison.ways.first->vehicle, comparison.a.rows.back().record.report.vehicle);
  EXPECT_THAT(way_line(comparison), testing::StartsWith("the first car to drive elsewhere: step "));
  EXPECT_THAT(way_line(comparison), testing::EndsWith(": 2 mm apart"));
  EXPECT_THAT(way_line(apart_by(1.25)), testing::EndsWith(": 1.25 m apart"));
  EXPECT_THAT(way_line(apart_by(0.0, 0.1)), HasSubstr("or turned"));
  EXPECT_EQ(way_line(apart_by(0.0)), "all cars drive the same way");
}

TEST(RunComparison, OfWaysThatAreNotRecordedNothingIsClaimed) {
  ComparedRun other = driven_run(2);
  other.rows[1].record.report.level = 1;
  other.rows.pop_back();
  EXPECT_EQ(way_line(compare(driven_run(2), std::move(other), {})),
            "where both are recorded, all cars drive the same way");
}

TEST(RunComparison, VehiclesWithOtherNumbersAndThoseOfOneRunHaveTheirOwnRows) {
  ComparedRun other = driven_run(2);
  other.summary.vehicles[0].fallback_steps = 4;
  const ComparisonTable table = vehicle_table(compare(driven_run(1), std::move(other), {}));
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_THAT(table.rows[0],
              ElementsAre("1 car", "first", "-", "3.000", "1.500", "-", "-", "0", "-"));
  EXPECT_THAT(table.rows[1],
              ElementsAre("1 car", "second", "-", "3.000", "1.500", "-", "-", "4", "-"));
  EXPECT_EQ(table.rows[2][0], "2 car");
  EXPECT_EQ(table.rows[2][1], "second");
}

TEST(RunComparison, TablesHaveACellForEveryColumn) {
  const RunComparison comparison = compare(driven_run(2), driven_run(3), {});
  for (const ComparisonTable& table : {vehicle_table(comparison), run_table(comparison)}) {
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.heading.size());
  }
}

TEST(RunComparison, AsTextHasShortLinesAndEndsWithALineBreak) {
  const std::string text = comparison_text(compare(driven_run(2), driven_run(2), {}));
  EXPECT_TRUE(text.ends_with("\n"));
  EXPECT_THAT(text, HasSubstr("\ncollisions "));
  for (const std::string& line : split(text, '\n')) EXPECT_LE(line.size(), 120U) << line;
}

TEST(RunComparison, ARunThatDidNotStartIsCompared) {
  ComparedRun standing = driven_run(1);
  standing.facts.first_step.reset();
  standing.rows.clear();
  const RunComparison comparison = compare(std::move(standing), driven_run(1), {});
  ASSERT_TRUE(comparison.first);
  EXPECT_EQ(vehicle_table(comparison).rows.at(0).at(3), "-");
}

}  // namespace
}  // namespace hlc::result
