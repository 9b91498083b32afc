#include "hlc_bridge/result/first_difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace hlc::result::first_difference_test {
namespace {

using coordination::FallbackReason;
using coordination::Report;
using coordination::StepStatus;

constexpr std::uint64_t kSteps = 3;
constexpr std::uint64_t kVehicles = 3;

using Rows = std::vector<StepRecord>;

Rows run(std::uint64_t first_step = 10) {
  Rows rows;
  for (std::uint64_t step = 0; step < kSteps; ++step) {
    for (std::uint8_t id = 1; id <= kVehicles; ++id) {
      StepRecord row;
      row.step = step;
      row.driven = Pose{1.0 + id, 2.0, 0.5};
      row.driven_speed_mps = 0.75;
      Report& report = row.record.report;
      report.vehicle = VehicleId{id};
      report.step = StepIndex{first_step + step};
      report.status = StepStatus::kPlanned;
      report.planned_pose = {1.0 + id, 2.0, 0.5};
      report.maneuver = "straight";
      report.subgraph = "all";
      report.cost_m2 = 0.012;
      report.generated = 20;
      report.expanded = 10;
      report.coupled = {VehicleId{9}};
      report.waiting = {.vehicles = {VehicleId{9}}, .since = StepIndex{first_step}};
      rows.push_back(row);
    }
  }
  return rows;
}

StepRecord& row_of(Rows& rows, std::uint64_t step, std::uint64_t vehicle) {
  return rows.at(step * kVehicles + vehicle - 1);
}

using Change = std::function<void(StepRecord&)>;

/// Of a run and the same with the change in step 1 of vehicle 2.
std::string text_after(const Change& change) {
  Rows changed = run();
  change(row_of(changed, 1, 2));
  const std::optional<Difference> difference = first_difference(run(), changed);
  if (!difference) return "equal";
  EXPECT_EQ(difference->step, 1U);
  EXPECT_EQ(difference->vehicle, VehicleId{2});
  return difference->text;
}

std::string text_after_report(const std::function<void(Report&)>& change) {
  return text_after([&](StepRecord& row) { change(row.record.report); });
}

TEST(FirstDifference, EqualRunsHaveNone) {
  EXPECT_FALSE(first_difference(run(), run()));
  EXPECT_FALSE(first_difference({}, {}));
}

TEST(FirstDifference, NothingMeasuredByAClockCounts) {
  EXPECT_EQ(text_after([](StepRecord& row) {
              row.record.planning_ns = 1;
              row.record.response_ns = 2;
              row.record.deadline_missed = true;
              row.record.late_ns = 3;
            }),
            "equal");
  EXPECT_FALSE(first_difference(run(10), run(5000)));
}

TEST(FirstDifference, OfTheInputIsNamedWithBothValues) {
  EXPECT_EQ(text_after([](StepRecord& row) { row.driven->x_m = 3.0001; }),
            "input: driven x 3 m and 3.0001 m, 0.1 mm apart");
  EXPECT_EQ(text_after([](StepRecord& row) { row.driven->y_m = 2.5; }),
            "input: driven y 2 m and 2.5 m, 0.5 m apart");
  EXPECT_EQ(text_after([](StepRecord& row) { row.driven->heading_rad = 0.25; }),
            "input: driven yaw 0.5 rad and 0.25 rad, 0.25 rad apart");
  EXPECT_EQ(text_after([](StepRecord& row) { row.driven_speed_mps = 0.5; }),
            "input: driven speed 0.75 m/s and 0.5 m/s, 0.25 m/s apart");
  EXPECT_EQ(text_after([](StepRecord& row) { row.driven.reset(); }),
            "input: driven pose recorded in the first run only");
  EXPECT_EQ(text_after([](StepRecord& row) { row.driven_speed_mps.reset(); }),
            "input: driven speed recorded in the first run only");
  EXPECT_EQ(text_after_report([](Report& report) { report.deviation_m = 0.002; }),
            "input: measured deviation 0 m and 0.002 m, 2 mm apart");
}

TEST(FirstDifference, OfASingleBitCounts) {
  EXPECT_EQ(text_after([](StepRecord& row) { row.driven->y_m = std::nextafter(2.0, 3.0); }),
            "input: driven y 2 m and 2.0000000000000004 m, 4.4e-13 mm apart");
  EXPECT_EQ(text_after_report([](Report& report) { report.deviation_m = -0.0; }),
            "input: measured deviation 0 m and -0 m, 0 mm apart");
  Rows both = run();
  row_of(both, 1, 2).driven->x_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(first_difference(both, both));
}

TEST(FirstDifference, OfTheMessagesNamesTheVehicle) {
  EXPECT_EQ(text_after_report([](Report& report) { report.missing = {VehicleId{3}}; }),
            "messages: vehicle 3 is missing in the second run only");
  EXPECT_EQ(text_after_report([](Report& report) { report.coupled.clear(); }),
            "messages: vehicle 9 is coupled in the first run only");
  EXPECT_EQ(text_after_report([](Report& report) {
              report.coupled = {VehicleId{9}, VehicleId{8}, VehicleId{7}};
            }),
            "messages: vehicle 7 is coupled in the second run only");
  EXPECT_EQ(text_after_report([](Report& report) { report.level = 2; }),
            "messages: computation level 0 and 2");
}

TEST(FirstDifference, OfTheDecisionNamesReasonAndVehicles) {
  const auto fall_back = [](Report& report, std::vector<VehicleId> because_of) {
    report.status = StepStatus::kFallback;
    report.reason = FallbackReason::kConflict;
    report.blocked_by = std::move(because_of);
  };
  EXPECT_EQ(text_after_report([&](Report& report) { fall_back(report, {VehicleId{1}}); }),
            "plan: planned and fallback (conflict, because of vehicle 1)");
  EXPECT_EQ(text_after_report([&](Report& report) { fall_back(report, {}); }),
            "plan: planned and fallback (conflict)");
  EXPECT_EQ(text_after_report([](Report& report) {
              report.blocked_by = {VehicleId{1}, VehicleId{3}};
            }),
            "plan: planned and planned (because of vehicles 1, 3)");
}

TEST(FirstDifference, OfThePlanIsNamedWithBothValues) {
  EXPECT_EQ(text_after_report([](Report& report) { report.waiting = {}; }),
            "plan: waiting for vehicle 9 since step 0 and for none");
  EXPECT_EQ(text_after_report([](Report& report) { report.waiting.since.value += 1; }),
            "plan: waiting for vehicle 9 since step 0 and for vehicle 9 since step 1");
  EXPECT_EQ(text_after_report([](Report& report) { report.cost_m2 = 0.013; }),
            "plan: cost 0.012 m^2 and 0.013 m^2, 0.001 m^2 apart");
  EXPECT_EQ(text_after_report(
                [](Report& report) { report.quality = coordination::PlanQuality::kBudget; }),
            "plan: quality none and budget");
  EXPECT_EQ(text_after_report([](Report& report) { report.gap_m2 = 0.5; }),
            "plan: gap to the optimum 0 m^2 and 0.5 m^2, 0.5 m^2 apart");
  EXPECT_EQ(text_after_report([](Report& report) { report.generated = 21; }),
            "plan: generated vertices 20 and 21");
  EXPECT_EQ(text_after_report([](Report& report) { report.expanded = 11; }),
            "plan: expanded vertices 10 and 11");
  EXPECT_EQ(text_after_report([](Report& report) { report.planned_pose.x_m = 3.5; }),
            "plan: planned x 3 m and 3.5 m, 0.5 m apart");
  EXPECT_EQ(text_after_report([](Report& report) { report.planned_trim = TrimId{4}; }),
            "plan: planned trim 1 and 5");
  EXPECT_EQ(text_after_report([](Report& report) { report.maneuver = "left\n"; }),
            R"(plan: maneuver "straight" and "left\n")");
  EXPECT_EQ(text_after_report([](Report& report) { report.subgraph = "slow"; }),
            R"(plan: subgraph "all" and "slow")");
}

TEST(FirstDifference, PrefersTheCauseToItsConsequence) {
  Rows changed = run();
  row_of(changed, 2, 1).driven->x_m = 0.0;  // a later step
  row_of(changed, 1, 1).record.report.cost_m2 = 1.0;
  const auto first = [&] { return first_difference(run(), changed).value(); };
  EXPECT_EQ(first().step, 1U);
  EXPECT_EQ(first().vehicle, VehicleId{1});

  row_of(changed, 1, 2).record.report.cost_m2 = 1.0;
  EXPECT_EQ(first().vehicle, VehicleId{1}) << "of equal kinds the smallest id";

  row_of(changed, 1, 2).record.report.level = 1;
  EXPECT_EQ(first().vehicle, VehicleId{2}) << "messages before plans";
  EXPECT_EQ(first().text.substr(0, 8), "messages");

  row_of(changed, 1, 3).driven_speed_mps = 0.0;
  EXPECT_EQ(first().vehicle, VehicleId{3}) << "input before messages";
  EXPECT_EQ(first().text.substr(0, 5), "input");

  changed.erase(changed.begin() + kVehicles);
  EXPECT_EQ(first().vehicle, VehicleId{1}) << "reports before input";
  EXPECT_EQ(first().text, "reports: this vehicle in the first run only");
  EXPECT_EQ(first_difference(changed, run()).value().text,
            "reports: this vehicle in the second run only");
}

TEST(FirstDifference, OfAShorterRunIsTheFirstStepBeyondIt) {
  Rows shorter = run();
  shorter.resize(2 * kVehicles);
  const Difference second_ends = first_difference(run(), shorter).value();
  EXPECT_EQ(second_ends.step, 2U);
  EXPECT_EQ(second_ends.vehicle, VehicleId{1});
  EXPECT_EQ(second_ends.text, "reports: this step in the first run only");
  EXPECT_EQ(first_difference({}, run()).value().text, "reports: this step in the second run only");
}

}  // namespace
}  // namespace hlc::result::first_difference_test
