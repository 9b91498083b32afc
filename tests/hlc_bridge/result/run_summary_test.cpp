#include "hlc_bridge/result/run_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "hlc_bridge/result/summary_table.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::result::run_summary_test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kPi = std::numbers::pi;
constexpr Nanoseconds kPeriod = 200'000'000;

/// Two cars on a circle of 1 m at 0.8 m/s, planned 10 mm outside, driven 3 mm ahead of the plan,
/// half a turn apart, for `steps` steps from k0 = 5 on.
class RunSummaryTest : public testing::Test {
 protected:
  void SetUp() override {
    std::vector<Point> points_m;
    for (int i = 0; i < 3600; ++i) {
      points_m.emplace_back(std::cos(2.0 * kPi * i / 3600.0), std::sin(2.0 * kPi * i / 3600.0));
    }
    const road::ReferencePath route{points_m, true};
    description_ = {.scenario = "test",
                    .profile = "default",
                    .map = "circle",
                    .noise_seed = 1,
                    .subgraph = "B",
                    .horizon_steps = 8,
                    .step_s = 0.2,
                    .vehicles = {{VehicleId{1}, "red", route, {0.22, 0.107}},
                                 {VehicleId{2}, "blue", route, {0.22, 0.107}}}};
    facts_.period = kPeriod;
    facts_.steps = 60;
    facts_.first_step = 5;
    facts_.wall_s = 0.5;
    facts_.clock_s = 13.2;
    for (std::uint64_t k = 0; k < 66; ++k) {
      for (std::uint8_t id = 1; id <= 2; ++id) {
        add(id, k);
      }
    }
  }

  void add(std::uint8_t id, std::uint64_t k) {
    const double angle = 0.16 * static_cast<double>(k) + kPi * id;
    ReportRecord record;
    record.report.vehicle = VehicleId{id};
    record.report.step = StepIndex{k};
    record.report.status =
        k < 5 ? coordination::StepStatus::kStandby : coordination::StepStatus::kPlanned;
    record.report.planned_pose = {1.01 * std::cos(angle), 1.01 * std::sin(angle),
                                  angle + kPi / 2.0};
    record.report.generated = 10 * k + id;
    record.report.expanded = k;
    record.planning_ns = 1'000'000 * k;
    reports_.push_back(record);
    DrivenSample sample;
    sample.t = k * kPeriod;
    sample.pose = record.report.planned_pose;
    sample.pose.x_m -= 0.003 * std::sin(angle);
    sample.pose.y_m += 0.003 * std::cos(angle);
    drives_[id].push_back(sample);
  }

  RunSummary summary() {
    return summarize(description_, facts_, step_records(reports_, drives_, facts_), drives_);
  }

  ReportRecord& report(std::uint8_t id, std::uint64_t step) {
    return reports_.at((step + 5) * 2 + id - 1U);
  }

  RunDescription description_;
  RunFacts facts_;
  std::vector<ReportRecord> reports_;
  Drives drives_;
};

TEST_F(RunSummaryTest, ErrorsAndLapAreThoseOfTheMotion) {
  const RunSummary result = summary();
  EXPECT_EQ(result.steps, 60U);
  ASSERT_EQ(result.vehicles.size(), 2U);
  for (const VehicleSummary& vehicle : result.vehicles) {
    EXPECT_EQ(vehicle.steps, 60U);
    EXPECT_NEAR(vehicle.lap_s.value(), 2.0 * kPi / 0.8, 1e-3);
    EXPECT_NEAR(vehicle.reference_error_m->mean, 0.010, 1e-5);
    EXPECT_NEAR(vehicle.reference_error_m->std, 0.0, 1e-5);
    // Driven 3 mm along the circle.
    EXPECT_NEAR(vehicle.driven_error_m->mean, 0.010, 2e-5);
    EXPECT_NEAR(vehicle.tracking_error_m->mean, 0.003, 1e-9);
    EXPECT_NEAR(vehicle.tracking_error_m->max, 0.003, 1e-9);
  }
  EXPECT_GT(result.min_footprint_distance_m.value(), 1.7);
  EXPECT_EQ(result.collisions, 0U);
  EXPECT_DOUBLE_EQ(result.realtime_factor, 26.4);
  EXPECT_EQ(result.trace_sha256.size(), 64U);
}

TEST_F(RunSummaryTest, ResponseTimesAreThoseOfAllVehiclesInRealTime) {
  EXPECT_FALSE(summary().response_s) << "the clock of a run in logical time stands";
  for (ReportRecord& one : reports_) one.response_ns = 2'000'000U * one.report.vehicle.value;
  report(2, 30).response_ns = 50'000'000;
  const std::optional<Statistics> response_s = summary().response_s;
  ASSERT_TRUE(response_s);
  EXPECT_EQ(response_s->count, 120U);
  EXPECT_NEAR(response_s->p99, 4e-3, 1e-12);
  EXPECT_NEAR(response_s->max, 50e-3, 1e-12);
}

TEST_F(RunSummaryTest, ErrorOfDrivenPositionsIsThatOfTheDrive) {
  for (DrivenSample& sample : drives_[1]) {
    sample.pose.x_m *= 1.02;  // circles about the origin
    sample.pose.y_m *= 1.02;
  }
  const RunSummary result = summary();
  EXPECT_NEAR(result.vehicles[0].reference_error_m->mean, 0.010, 1e-5);
  EXPECT_NEAR(std::abs(result.vehicles[0].driven_error_m->mean - 0.010), 0.02, 1e-3);
  drives_.clear();
  EXPECT_FALSE(summary().vehicles[0].driven_error_m);
}

TEST_F(RunSummaryTest, TheFirstStepInWhichAllStandIsNoPartOfTheLap) {
  report(1, 0).report.planned_pose = report(1, 1).report.planned_pose;
  EXPECT_NEAR(summary().vehicles[0].lap_s.value(), 2.0 * kPi / 0.8, 1e-3);
}

// One car drives straight on at 0.8 m/s and is 5 mm beside its plan at one tick between two steps.
TEST_F(RunSummaryTest, TrackingIsLookedAtBetweenTheStepsToo) {
  reports_.clear();
  drives_.clear();
  description_.vehicles.pop_back();
  description_.automaton = std::make_shared<const automaton::Subgraph>(test::make_test_subgraph());
  const double yaw_rad =
      automaton::yaw_minus_heading_rad(0.0, description_.automaton->automaton().vehicle,
                                       description_.automaton->automaton().identified);
  for (std::uint64_t k = 5; k < 65; ++k) {
    ReportRecord record;
    record.report.vehicle = VehicleId{1};
    record.report.step = StepIndex{k};
    record.report.status = coordination::StepStatus::kPlanned;
    record.report.planned_pose = {0.16 * static_cast<double>(k), 0.0, 0.0};
    record.report.planned_trim = TrimId{6};
    record.report.maneuver = automaton::kSelfLoopLabel;
    reports_.push_back(record);
    for (std::uint64_t tick = 0; tick < 10; ++tick) {
      DrivenSample sample;
      sample.t = k * kPeriod + tick * kPeriod / 10;
      sample.pose = {0.16 * (static_cast<double>(k) + 0.1 * static_cast<double>(tick)), 0.0,
                     yaw_rad};
      if (k == 20 && tick == 7) sample.pose.y_m = 0.005;
      drives_[1].push_back(sample);
    }
  }
  const VehicleSummary result = summary().vehicles.at(0);
  EXPECT_NEAR(result.tracking_error_m->max, 0.005, 1e-9);
  EXPECT_NEAR(result.tracking_error_m->mean, 0.005 / (59 * 10 + 1), 1e-9);
  EXPECT_NEAR(result.deviation_max_m.value(), 0.005, 2e-4);
  EXPECT_EQ(result.steps_outside_announced_area, 0U);
  reports_.front().report.maneuver = "";  // no plan yet: its pose means nothing
  reports_.front().report.planned_pose = {};
  EXPECT_NEAR(summary().vehicles.at(0).tracking_error_m->max, 0.005, 1e-9);
  reports_.at(30).report.status = coordination::StepStatus::kFallback;
  reports_.at(30).report.reason = coordination::FallbackReason::kDeviation;
  EXPECT_EQ(summary().vehicles.at(0).steps_outside_announced_area, 0U)
      << "not seen, but not known to be off";
  reports_.at(30).report.deviation_m = 0.011;
  EXPECT_EQ(summary().vehicles.at(0).steps_outside_announced_area, 1U);
}

TEST_F(RunSummaryTest, TheTableNamesTwoRounds) {
  EXPECT_EQ(summary_table(summary()).find("rounds"), std::string::npos);
  description_.has_two_rounds = true;
  EXPECT_NE(summary_table(summary()).find("subgraph B, two rounds, profile"), std::string::npos);
}

TEST_F(RunSummaryTest, TheTableNamesTheMapOrThatThereIsNone) {
  description_.map = "lab_like.xml";
  EXPECT_NE(summary_table(summary()).find(", map lab_like.xml, "), std::string::npos);
  description_.map = "";
  EXPECT_NE(summary_table(summary()).find(", no map, "), std::string::npos);
}

TEST_F(RunSummaryTest, StepsWhosePlanOrCommandIsNotSentAreCountedAndTold) {
  EXPECT_EQ(summary().vehicles.at(0).undrivable_steps, 0U);
  EXPECT_EQ(summary_table(summary()).find("commands not sent"), std::string::npos);
  for (ReportRecord& record : reports_) {
    if (record.report.vehicle.value == 1 && record.report.step.value % 4 == 0) {
      record.report.status = coordination::StepStatus::kFallback;
      record.report.reason = coordination::FallbackReason::kUndrivable;
    }
  }
  const std::size_t counted = summary().vehicles.at(0).undrivable_steps;
  EXPECT_GT(counted, 3U);
  EXPECT_EQ(summary().vehicles.at(0).fallback_steps, counted);
  EXPECT_NE(summary_table(summary()).find("commands not sent: beyond the lab's limits   " +
                                          std::to_string(counted) + "\n"),
            std::string::npos);
}

// A car that drives its plan exactly, with the two maneuvers between two trims in turn.
TEST_F(RunSummaryTest, OfSeveralManeuversBetweenTwoTrimsTheOneThatWasPlannedIsComparedWith) {
  reports_.clear();
  drives_.clear();
  description_.vehicles.pop_back();
  const auto automaton =
      test::make_test_automaton(test::paper_trims(), {{"slow", 0.0}, {"fast", 8.0}});
  automaton::SubgraphSpec spec{
      .name = "both", .labels = {"slow", "fast"}, .trims = {{0}, {6}, {7}}};
  description_.automaton = std::make_shared<const automaton::Subgraph>(automaton, spec);
  Pose pose;
  for (std::uint64_t k = 5; k < 65; ++k) {
    const TrimId from{k % 2 == 0 ? 6U : 7U};
    const TrimId to{k % 2 == 0 ? 7U : 6U};
    const automaton::Maneuver& maneuver = *automaton->find(from, to, k % 3 == 0 ? "slow" : "fast");
    ReportRecord record;
    record.report.vehicle = VehicleId{1};
    record.report.step = StepIndex{k};
    record.report.status = coordination::StepStatus::kPlanned;
    record.report.planned_pose = pose;
    record.report.planned_trim = from;
    record.report.maneuver = maneuver.label;
    reports_.push_back(record);
    for (std::uint64_t tick = 0; tick < 10; ++tick) {
      const vehicle::State state =
          automaton::state_at(maneuver, 0.02 * static_cast<double>(tick), automaton->vehicle);
      DrivenSample sample;
      sample.t = k * kPeriod + tick * kPeriod / 10;
      sample.pose = compose(pose, state.pose);
      drives_[1].push_back(sample);
    }
    pose = compose(pose, maneuver.displacement);
  }
  EXPECT_LT(summary().vehicles.at(0).tracking_error_m->max, 1e-9);
}

TEST_F(RunSummaryTest, CountsAreThoseOfTheStepsOfTheExperiment) {
  report(2, 7).report.status = coordination::StepStatus::kFallback;
  report(2, 9).report.status = coordination::StepStatus::kFallback;
  report(1, 3).deadline_missed = true;
  const RunSummary result = summary();
  EXPECT_EQ(result.vehicles[0].generated->max, 641.0);  // k = 64 is the last step
  EXPECT_EQ(result.vehicles[1].generated->max, 642.0);
  EXPECT_EQ(result.vehicles[0].expanded->max, 64.0);
  EXPECT_EQ(result.vehicles[0].expanded->min, 5.0);
  EXPECT_DOUBLE_EQ(result.vehicles[0].planning_s->max, 0.064);
  EXPECT_EQ(result.generated_vertices_sum_max, 641U + 642U);
  EXPECT_EQ(result.expanded_vertices_sum_max, 2U * 64U);
  EXPECT_EQ(result.vehicles[0].plans_exceeding_step, 0U);
  EXPECT_EQ(result.vehicles[0].fallback_steps, 0U);
  EXPECT_EQ(result.vehicles[1].fallback_steps, 2U);
  EXPECT_EQ(result.vehicles[0].deadline_misses, 1U);
}

TEST_F(RunSummaryTest, EveryStepThatAControllerSkippedIsADeadlineMissed) {
  // Of vehicle 2: three steps on the way, and the last two of the 60 (k0 = 5).
  std::erase_if(reports_, [](const ReportRecord& row) {
    const std::uint64_t k = row.report.step.value;
    return row.report.vehicle == VehicleId{2} && ((k >= 20 && k < 23) || k >= 63);
  });
  EXPECT_EQ(summary().vehicles[0].deadline_misses, 0U);
  EXPECT_EQ(summary().vehicles[1].deadline_misses, 5U);
  facts_.simulated_time = true;  // there every list is answered, or its controller is dead
  EXPECT_EQ(summary().vehicles[1].deadline_misses, 0U);
}

TEST_F(RunSummaryTest, StepsWithoutPlanningDoNotCountForPlanning) {
  for (std::uint64_t step = 30; step < 60; ++step) {
    report(1, step).report.status = coordination::StepStatus::kMinimalRiskStop;
    report(1, step).report.generated = 0;
  }
  const RunSummary result = summary();
  EXPECT_EQ(result.vehicles[0].generated->count, 30U);
  EXPECT_EQ(result.vehicles[0].generated->min, 51.0);
  EXPECT_EQ(result.vehicles[0].planning_s->count, 30U);
}

TEST_F(RunSummaryTest, BudgetShareIsThatOfThePlansFound) {
  EXPECT_FALSE(summary().vehicles[0].budget_share);  // none was found
  EXPECT_EQ(summary_table(summary()).find("budget"), std::string::npos);
  for (std::uint64_t step = 30; step < 40; ++step) {
    report(1, step).report.quality =
        step < 33 ? coordination::PlanQuality::kBudget : coordination::PlanQuality::kOptimal;
  }
  EXPECT_EQ(summary().vehicles[0].budget_share, 0.3);
  EXPECT_FALSE(summary().vehicles[1].budget_share);
  EXPECT_THAT(
      summary_table(summary()),
      HasSubstr("plans cut off by the search's budget         up to 30.0 % of a vehicle's\n"));
}

TEST_F(RunSummaryTest, CostIsThatOfThePlansFoundAndSpeedThatOfTheDriveAtTheSteps) {
  EXPECT_FALSE(summary().vehicles[0].plan_cost_m2);
  report(1, 3).report.quality = coordination::PlanQuality::kOptimal;
  report(1, 3).report.cost_m2 = 0.25;
  report(1, 4).report.quality = coordination::PlanQuality::kBudget;
  report(1, 4).report.cost_m2 = 0.75;
  report(1, 5).report.cost_m2 = 9.0;  // none was found
  std::vector<StepRecord> rows = step_records(reports_, drives_, facts_);
  for (StepRecord& row : rows) {
    const double later_mps = row.step < 30 ? 0.4 : 0.8;
    row.driven_speed_mps = row.record.report.vehicle == VehicleId{1} ? later_mps : 0.0;
  }
  const VehicleSummary red = summarize(description_, facts_, rows, drives_).vehicles[0];
  ASSERT_TRUE(red.plan_cost_m2);
  EXPECT_DOUBLE_EQ(red.plan_cost_m2->mean, 0.5);
  ASSERT_TRUE(red.driven_speed_mps);
  EXPECT_NEAR(red.driven_speed_mps->mean, 0.6, 1e-12);
  EXPECT_DOUBLE_EQ(red.driven_speed_mps->max, 0.8);
}

TEST_F(RunSummaryTest, AVehicleThatIsAtItsGoalAtTheEndHasArrived) {
  EXPECT_FALSE(summary().vehicles[0].arrived_s);
  EXPECT_THAT(summary_table(summary()), Not(HasSubstr("arrived")));
  report(1, 30).report.arrived_since = {{5 + 30}};
  EXPECT_FALSE(summary().vehicles[0].arrived_s) << "it left";
  for (std::uint64_t step = 40; step < 60; ++step) {
    report(1, step).report.arrived_since = {{5 + 40}};
  }
  EXPECT_DOUBLE_EQ(summary().vehicles[0].arrived_s.value(), 8.0);
  EXPECT_FALSE(summary().vehicles[1].arrived_s);
  const std::string table = summary_table(summary());
  EXPECT_THAT(table, HasSubstr(" arrived at 8.0 s "));
  const std::size_t heading = table.find(" id  vehicle");
  const std::size_t row = table.find("\n  1  red") + 1;
  EXPECT_EQ(table.find('\n', heading) - heading, table.find('\n', row) - row);
}

TEST_F(RunSummaryTest, ATouchedObstacleIsACollision) {
  EXPECT_FALSE(summary().min_obstacle_distance_m);
  const auto stands_at = [&](double x_m) {
    description_.obstacles = {
        {.name = "cone", .area_m = footprint_area({0.1, 0.1}, {x_m, 0.0, 0.0})}};
  };
  stands_at(1.3);
  EXPECT_EQ(summary().collisions, 0U);
  EXPECT_GT(summary().min_obstacle_distance_m.value(), 0.1);
  EXPECT_THAT(summary_table(summary()), HasSubstr("smallest distance to an obstacle             "));
  stands_at(1.0);
  EXPECT_GT(summary().collisions, 0U);
  EXPECT_EQ(summary().min_obstacle_distance_m, 0.0);
}

/// Steps 20 ... 30 of the run, in which vehicle 1 waits for another one, then shorter again.
TEST_F(RunSummaryTest, TheLongestWaitNamesTheOthers) {
  EXPECT_FALSE(summary().vehicles[0].wait);
  EXPECT_EQ(summary_table(summary()).find("wait"), std::string::npos);
  for (std::uint64_t step = 20; step <= 30; ++step) {
    report(1, step).report.waiting = {.vehicles = {{2}}, .since = {5 + 20}};
  }
  report(1, 30).report.waiting.vehicles = {{3}};
  for (std::uint64_t step = 40; step <= 45; ++step) {
    report(1, step).report.waiting = {.vehicles = {{4}}, .since = {5 + 40}};
  }
  const RunSummary result = summary();
  ASSERT_TRUE(result.vehicles[0].wait);
  EXPECT_DOUBLE_EQ(result.vehicles[0].wait->duration_s, 2.2);
  EXPECT_EQ(result.vehicles[0].wait->since_step, 20U);
  EXPECT_EQ(result.vehicles[0].wait->vehicles, (std::vector<VehicleId>{{2}, {3}}));
  EXPECT_FALSE(result.vehicles[1].wait);
  EXPECT_DOUBLE_EQ(longest_wait_s(result), 2.2);
  EXPECT_TRUE(stuck_vehicles(result).empty());
  const std::string table = summary_table(result);
  EXPECT_THAT(
      table,
      HasSubstr("longest wait for others, of every vehicle    2.2 s, vehicle 1 for 2 3, from 4.0 s "
                "on\n"));
  EXPECT_THAT(table, Not(HasSubstr("stuck at the end")));
  for (std::uint8_t id = 10; id < 25; ++id) report(1, 30).report.waiting.vehicles.push_back({id});
  EXPECT_THAT(summary_table(summary()), HasSubstr("for 2 3 10 11 12 13 14 15 ..., from 4.0 s on"));
}

TEST_F(RunSummaryTest, EveryVehicleThatWaitedHasALineTheLongestFirst) {
  report(1, 20).report.waiting = {.vehicles = {{2}}, .since = {5 + 20}};
  for (std::uint64_t step = 40; step <= 45; ++step) {
    report(2, step).report.waiting = {.vehicles = {{1}}, .since = {5 + 40}};
  }
  EXPECT_THAT(
      summary_table(summary()),
      HasSubstr("longest wait for others, of every vehicle    1.2 s, vehicle 2 for 1, from 8.0 s "
                "on\n"
                "                                               0.2 s, vehicle 1 for 2, from 4.0 s "
                "on\n"));
}

TEST_F(RunSummaryTest, AVehicleIsStuckByItsLastStepAlone) {
  for (std::uint64_t step = 50; step < 60; ++step) {
    report(2, step).report.waiting = {.vehicles = {{1}}, .since = {5}};
  }
  EXPECT_DOUBLE_EQ(longest_wait_s(summary()), 12.0);
  EXPECT_TRUE(stuck_vehicles(summary()).empty());
  description_.step_s = 0.4;
  EXPECT_DOUBLE_EQ(longest_wait_s(summary()), 24.0);
  EXPECT_EQ(stuck_vehicles(summary()), std::vector<VehicleId>{{2}});
  EXPECT_THAT(summary_table(summary()),
              HasSubstr("stuck at the end: vehicles                   2\n"));
  report(2, 59).report.waiting = {};
  EXPECT_DOUBLE_EQ(longest_wait_s(summary()), 23.6);
  EXPECT_TRUE(stuck_vehicles(summary()).empty()) << "it got on";
}

TEST_F(RunSummaryTest, WithoutRouteThereIsNeitherLapNorReferenceError) {
  description_.vehicles[0].route.reset();
  const RunSummary result = summary();
  EXPECT_FALSE(result.vehicles[0].lap_s);
  EXPECT_FALSE(result.vehicles[0].reference_error_m);
  EXPECT_TRUE(result.vehicles[0].tracking_error_m);
}

TEST_F(RunSummaryTest, VehicleThatDiedKeepsItsStepsSoFar) {
  std::erase_if(reports_, [](const ReportRecord& record) {
    return record.report.vehicle.value == 2 && record.report.step.value >= 20;
  });
  drives_.erase(2);
  const RunSummary result = summary();
  EXPECT_EQ(result.vehicles[0].steps, 60U);
  EXPECT_EQ(result.vehicles[1].steps, 15U);
  EXPECT_FALSE(result.vehicles[1].tracking_error_m);
  EXPECT_FALSE(result.min_footprint_distance_m);
}

TEST_F(RunSummaryTest, RunThatNeverStartedIsEmptyNotWrong) {
  facts_.first_step.reset();
  const RunSummary result = summary();
  EXPECT_EQ(result.steps, 0U);
  EXPECT_FALSE(result.vehicles[0].generated);
  EXPECT_FALSE(result.vehicles[0].lap_s);
  EXPECT_THAT(summary_table(result), HasSubstr("red"));
}

TEST_F(RunSummaryTest, TableShowsEveryVehicleInLinesOfAtMost110Columns) {
  const std::string table = summary_table(summary());
  EXPECT_THAT(table, HasSubstr("  1  red"));
  EXPECT_THAT(table, HasSubstr("10.0 (0.0)"));
  EXPECT_THAT(table, HasSubstr("7.85"));
  EXPECT_THAT(table, HasSubstr("3.0 / 3.0"));
  std::istringstream lines{table};
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 110U) << line;
  }
}

}  // namespace
}  // namespace hlc::result::run_summary_test
