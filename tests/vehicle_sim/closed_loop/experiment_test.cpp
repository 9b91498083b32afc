#include "vehicle_sim/closed_loop/experiment.hpp"

#include <gtest/gtest.h>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/result/planned_motion.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "tests/support/folders.hpp"
#include "vehicle_sim/campaign/campaign.hpp"

namespace hlc::closed_loop::experiment_test {
namespace {

scenario::Scenario scenario_of(const std::string& name) {
  return scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/" + name + ".yaml"});
}

result::RunSummary summary_of(const scenario::Scenario& scenario,
                              const ExperimentOptions& options) {
  const Experiment experiment = drive_experiment(scenario, options);
  EXPECT_EQ(experiment.facts.exit_code, 0) << experiment.facts.reason;
  const std::vector<result::StepRecord> rows =
      result::step_records(experiment.reports, experiment.drives, experiment.facts);
  return result::summarize(result::describe(scenario, options.noise_seed), experiment.facts, rows,
                           experiment.drives);
}

TEST(Experiment, DrivesThePapersScenarioToTheEnd) {
  const scenario::Scenario scenario = scenario_of("paper_three_cars");
  const result::RunSummary summary = summary_of(scenario, {.steps = 150});
  EXPECT_EQ(summary.steps, 150U);
  EXPECT_EQ(summary.collisions, 0U);
  ASSERT_EQ(summary.vehicles.size(), 3U);
  for (const result::VehicleSummary& vehicle : summary.vehicles) {
    EXPECT_EQ(vehicle.steps, 150U);
    EXPECT_EQ(vehicle.fallback_steps, 0U);
    EXPECT_EQ(vehicle.deadline_misses, 0U);
    ASSERT_TRUE(vehicle.tracking_error_m);
    EXPECT_LT(vehicle.tracking_error_m->max, 0.020);
    EXPECT_GT(vehicle.tracking_error_m->max, 0.0) << "the plan is not the drive";
  }
}

TEST(Experiment, DrivesAroundObstaclesUntilEveryCarHasArrived) {
  const scenario::Scenario scenario = scenario_of("obstacle_field");
  for (const std::optional<std::uint64_t> seed :
       {std::optional<std::uint64_t>{}, std::optional<std::uint64_t>{1}}) {
    const result::RunSummary summary =
        summary_of(scenario, {.steps = scenario.steps, .noise_seed = seed});
    EXPECT_EQ(summary.collisions, 0U);
    EXPECT_GT(summary.min_obstacle_distance_m.value(), 0.0);
    for (const result::VehicleSummary& vehicle : summary.vehicles) {
      EXPECT_TRUE(vehicle.arrived_s) << vehicle.name;
      EXPECT_FALSE(vehicle.is_stuck);
    }
  }
}

TEST(Experiment, MeasuresEveryStepOfAllControllersByTheClockOfProcessorTime) {
  Nanoseconds now = 0;
  const Experiment experiment = drive_experiment(
      scenario_of("paper_three_cars"),
      {.steps = 7, .clocks = {.wall = {}, .cpu = [&now] { return now += 1'000'000; }}});
  ASSERT_EQ(experiment.steps_s.size(), 8U) << "as the reports: with the list that ends the run";
  for (const double step_s : experiment.steps_s) {
    EXPECT_GT(step_s, 3e-3) << "the clock is read for each of three cars within the step, too";
  }
}

TEST(Experiment, DrivesMoreCarsThanTheLabHas) {
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_cars.yaml", .cars = 50});
  const result::RunSummary summary = summary_of(scenario, {.steps = 15});
  EXPECT_EQ(summary.collisions, 0U);
  ASSERT_EQ(summary.vehicles.size(), 50U);
  for (const result::VehicleSummary& vehicle : summary.vehicles) {
    EXPECT_EQ(vehicle.steps, 15U);
    ASSERT_TRUE(vehicle.tracking_error_m);
    EXPECT_LT(vehicle.tracking_error_m->max, 0.020);
  }
}

/// Ten cars on the lab's road, 12 s.
struct TenCars {
  scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_cars.yaml", .cars = 10});
  Experiment experiment = drive_experiment(scenario, {.steps = 60});
};

const TenCars& ten_cars() {
  static const TenCars kTenCars;
  return kTenCars;
}

/// Reports of a vehicle, by step.
std::vector<coordination::Report> reports_of(VehicleId vehicle, const Experiment& experiment) {
  std::vector<coordination::Report> reports;
  for (const ReportRecord& record : experiment.reports) {
    if (record.report.vehicle == vehicle) reports.push_back(record.report);
  }
  return reports;
}

// Without noise every plan stays where it is.
TEST(Experiment, ThePlanOfAReportIsWhatIsDrivenUntilAnotherOneComesIntoForce) {
  const auto& [scenario, experiment] = ten_cars();
  const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
  std::size_t num_moving = 0;
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    const std::vector<coordination::Report> reports = reports_of(vehicle.id, experiment);
    for (std::size_t k = 0; k + 1 < reports.size(); ++k) {
      SCOPED_TRACE(testing::Message() << "vehicle " << int{vehicle.id.value} << " step " << k);
      if (reports[k].status == coordination::StepStatus::kStandby) continue;
      const auto plan = result::planned_maneuvers(reports[k], automaton);
      ASSERT_EQ(plan.size(), reports[k].plan.size());
      ASSERT_LE(plan.size(), scenario.horizon_steps + 1);
      EXPECT_EQ(plan.front()->label, reports[k].maneuver);
      EXPECT_TRUE(automaton.trims[plan.back()->to.index].is_equilibrium());
      const Pose next = compose(reports[k].planned_pose, plan.front()->displacement);
      const Pose& reported = reports[k + 1].planned_pose;
      EXPECT_NEAR((next.position_m() - reported.position_m()).norm(), 0.0, 1e-9);
      num_moving += plan.front()->displacement.position_m().norm() > 0.0 ? 1U : 0U;
    }
  }
  EXPECT_GT(num_moving, 300U);
}

TEST(Experiment, NoPlanLeadsBeyondTheRoadThatItsReportHolds) {
  const auto& [scenario, experiment] = ten_cars();
  const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
  std::size_t num_checked = 0;
  for (const ReportRecord& record : experiment.reports) {
    const coordination::Report& report = record.report;
    if (report.status == coordination::StepStatus::kStandby) continue;
    ASSERT_TRUE(report.held);
    EXPECT_LT(report.held->route, scenario.conflicts->num_routes());
    double way_m = 0.0;
    for (const automaton::Maneuver* maneuver : result::planned_maneuvers(report, automaton)) {
      way_m += maneuver->displacement.position_m().norm();
    }
    EXPECT_LE(way_m, report.held->ahead_m + 0.05) << "chords are shorter than the lane's arc";
    ++num_checked;
  }
  EXPECT_GT(num_checked, 500U);
}

TEST(Experiment, NoiseOfTheSameSeedGivesTheSameTraceAndOfAnotherSeedAnother) {
  const scenario::Scenario scenario = scenario_of("circle");
  const std::string trace = summary_of(scenario, {.steps = 30, .noise_seed = 5}).trace_sha256;
  EXPECT_EQ(summary_of(scenario, {.steps = 30, .noise_seed = 5}).trace_sha256, trace);
  EXPECT_NE(summary_of(scenario, {.steps = 30, .noise_seed = 6}).trace_sha256, trace);
  EXPECT_NE(summary_of(scenario, {.steps = 30}).trace_sha256, trace);
}

struct RoundsCase {
  std::string scenario;
  std::optional<std::size_t> cars;
  std::optional<std::uint64_t> noise_seed;
  std::uint64_t steps{};
  double left_m{};  ///< of their lanes they start
};

void PrintTo(const RoundsCase& one, std::ostream* out) { *out << one.scenario; }

class TwoRounds : public testing::TestWithParam<RoundsCase> {};

// Vehicles deviate from their plans, and areas contain predicted drifts. Predictions are lost: with
// two rounds nobody needs one.
TEST_P(TwoRounds, DriveAsTheSequentialWayDoes) {
  scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/" + GetParam().scenario + ".yaml",
       .cars = GetParam().cars});
  for (scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    vehicle.start.x_m -= GetParam().left_m * std::sin(vehicle.start.heading_rad);
    vehicle.start.y_m += GetParam().left_m * std::cos(vehicle.start.heading_rad);
  }
  ExperimentOptions options{.steps = GetParam().steps, .noise_seed = GetParam().noise_seed};
  const Experiment sequential = drive_experiment(scenario, options);
  scenario.rounds = controller::Rounds::kTwo;
  options.rules.is_lost = [](const controller::Delivery& delivery) {
    return delivery.kind == controller::MessageKind::kPrediction;
  };
  std::size_t num_entering = 0;
  options.rules.on_traffic = [&](const controller::Controller&, const coordination::Traffic& one) {
    if (one.planning && one.planning->area.entry) ++num_entering;
  };
  const Experiment two = drive_experiment(scenario, options);
  EXPECT_EQ(num_entering > 0, GetParam().left_m > 0.0) << "vehicles that enter their lanes";
  ASSERT_EQ(two.reports.size(), sequential.reports.size());
  std::size_t num_coupled = 0;
  for (std::size_t i = 0; i < two.reports.size(); ++i) {
    const coordination::Report& a = sequential.reports[i].report;
    const coordination::Report& b = two.reports[i].report;
    num_coupled += a.coupled.size();
    ASSERT_EQ(a.vehicle, b.vehicle);
    ASSERT_EQ(a.status, b.status) << "step " << a.step.value;
    ASSERT_EQ(a.planned_pose, b.planned_pose) << "step " << a.step.value;
    ASSERT_EQ(a.cost_m2, b.cost_m2) << "step " << a.step.value;
    ASSERT_EQ(a.expanded, b.expanded) << "step " << a.step.value;
    ASSERT_EQ(a.waiting, b.waiting) << "step " << a.step.value;
  }
  EXPECT_GT(num_coupled, GetParam().steps);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, TwoRounds,
                         testing::Values(RoundsCase{"paper_three_cars", {}, 5, 100},
                                         RoundsCase{"lab_three_cars", {}, 1, 100},
                                         RoundsCase{"lab_cars", 8, 1, 60},
                                         RoundsCase{"circle", 6, {}, 60},
                                         RoundsCase{"paper_three_cars", {}, 2, 60, 0.09}),
                         [](const auto& tested) {
                           return tested.param.scenario +
                                  (tested.param.left_m > 0.0 ? "_beside" : "");
                         });

// Six cars on their way across a circle, and nobody makes room: 4, 5 and 6 get through, 1, 2 and 3
// stand in each other's way forever.
TEST(Experiment, SixCarsOnACircleWaitForEachOtherAndSayForWhom) {
  scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/circle.yaml", .cars = 6});
  scenario.profile.strategies.coordination = controller::kStrictCoordination;
  const Experiment experiment = drive_experiment(scenario, {.steps = 115});
  EXPECT_EQ(experiment.facts.exit_code, kExitStuck);
  EXPECT_EQ(experiment.facts.reason,
            "stuck at the end: vehicle 1, waiting for 3 for 20.8 s; vehicle 2, waiting for 1, 3 "
            "for 21.0 s; vehicle 3, waiting for 1, 2 for 21.0 s");
  const std::vector<result::StepRecord> rows =
      result::step_records(experiment.reports, experiment.drives, experiment.facts);
  const std::map<VehicleId, std::vector<VehicleId>> expected{
      {{1}, {{3}}}, {{2}, {{1}, {3}}}, {{3}, {{1}, {2}}}, {{4}, {}}, {{5}, {}}, {{6}, {}}};
  for (const result::StepRecord& row : rows) {
    const coordination::Report& report = row.record.report;
    if (row.step < 20) continue;
    EXPECT_EQ(report.waiting.vehicles, expected.at(report.vehicle))
        << unsigned{report.vehicle.value} << " in step " << row.step;
    EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);
  }
  const result::RunSummary summary = result::summarize(result::describe(scenario, std::nullopt),
                                                       experiment.facts, rows, experiment.drives);
  EXPECT_EQ(result::stuck_vehicles(summary), (std::vector<VehicleId>{{1}, {2}, {3}}));
  EXPECT_DOUBLE_EQ(result::longest_wait_s(summary), 21.0);

  const campaign::CampaignResult result = campaign::result_of(
      campaign::DrivenRun{.scenario = scenario, .experiment = experiment}, std::nullopt);
  EXPECT_EQ(result.fault, "") << "the run counts";
  const campaign::RunFigures figures = campaign::with_figures({}, result);
  EXPECT_EQ(figures.stuck_vehicles, 3U);
  EXPECT_DOUBLE_EQ(figures.longest_wait_s, 21.0);
}

TEST(Experiment, ALateControllerFallsBackAndSaysNothingMore) {
  const scenario::Scenario scenario = scenario_of("paper_red_alone");
  std::size_t asked = 0;
  controller::JointStepRules rules;
  rules.is_late = [&asked](const controller::Controller&) { return ++asked % 4 == 0; };
  const Experiment experiment = drive_experiment(scenario, {.steps = 20, .rules = rules});
  const auto is_late = [](const ReportRecord& record) {
    return record.report.reason == coordination::FallbackReason::kLate;
  };
  EXPECT_GE(asked, 19U);
  EXPECT_EQ(std::ranges::count_if(experiment.reports, is_late),
            static_cast<std::ptrdiff_t>(asked / 4));
}

TEST(Experiment, WallTimesAreThoseOfTheClockAndTheirSumIsNotMoreThanTheWhole) {
  Nanoseconds now = 0;
  const auto clock = [&now] { return now += 1'000; };
  const Experiment experiment =
      drive_experiment(scenario_of("paper_three_cars"), {.steps = 10, .clocks = {.wall = clock}});
  const WallTimes& wall = experiment.wall;
  EXPECT_GT(wall.planning_s, 0.0);
  EXPECT_GT(wall.coordination_s, 0.0);
  EXPECT_GT(wall.vehicles_s, 0.0);
  EXPECT_LE(wall.planning_s + wall.coordination_s + wall.vehicles_s, experiment.facts.wall_s);
  // One plan of a vehicle: two looks at the clock.
  EXPECT_NEAR(wall.planning_s, 3.0 * 10.0 * 1e-6, 1e-6 * 6.1);
}

TEST(Experiment, PlanningTimesOfTheReportsAreProcessorTime) {
  Nanoseconds now = 0;
  const auto cpu = [&now] { return now += 7; };
  const Experiment experiment =
      drive_experiment(scenario_of("paper_red_alone"), {.steps = 10, .clocks = {.cpu = cpu}});
  EXPECT_EQ(experiment.wall.planning_s, 0.0);
  std::size_t planned = 0;
  for (const ReportRecord& record : experiment.reports) {
    if (record.report.status != coordination::StepStatus::kPlanned) continue;
    ++planned;
    EXPECT_EQ(record.planning_ns, 2 * 7U) << "what to plan on, and the plan";
  }
  EXPECT_GE(planned, 9U);
}

TEST(Experiment, WithoutTheFollowersGainsNothingMoves) {
  const scenario::Scenario scenario = scenario_of("paper_red_alone");
  const Experiment experiment = drive_experiment(
      scenario, {.steps = 15, .gains = tracking::scaled(tracking::FollowerGains{}, 0.0)});
  const result::Drive& drive = experiment.drives.at(scenario.vehicles.front().id.value);
  EXPECT_EQ(drive.back().pose, drive.front().pose);
  // So the cars are outside the announced areas, which is a driving fault.
  scenario::Scenario three_cars = scenario_of("paper_three_cars");
  three_cars.steps = 15;
  const campaign::DrivenRun run =
      campaign::drive_run(three_cars, {.gains = tracking::scaled(tracking::FollowerGains{}, 0.0)});
  EXPECT_NE(campaign::result_of(run, std::nullopt).fault, "");
}

}  // namespace
}  // namespace hlc::closed_loop::experiment_test
