// Planning problems of CommonRoad files, driven in closed loop.
#include <gtest/gtest.h>

#include <numbers>
#include <ostream>
#include <random>
#include <string>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "planner/common/text_file.hpp"
#include "planner/scenario/commonroad_import.hpp"
#include "tests/support/commonroad_samples.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/temporary_folder.hpp"
#include "vehicle_sim/campaign/campaign.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::closed_loop::commonroad_test {
namespace {

scenario::Scenario scenario_of(const std::string& xml) {
  const test::TemporaryFolder folder;
  write_file(folder / "problem.xml", xml);
  return scenario::scenario_from_commonroad(
             {.file = folder / "problem.xml",
              .like =
                  test::source_folder() + "/launch_scripts/scenarios/passenger_cars_in_town.yaml",
              .out = folder / "out.yaml"})
      .scenario;
}

/// Every vehicle arrives in its goal within the run, and touches nothing.
void expect_solved(const scenario::Scenario& scenario) {
  const ExperimentOptions options{.steps = scenario.steps};
  const Experiment experiment = drive_experiment(scenario, options);
  ASSERT_EQ(experiment.facts.exit_code, 0) << experiment.facts.reason;
  const result::RunSummary summary = result::summarize(
      result::describe(scenario, options.noise_seed), experiment.facts,
      result::step_records(experiment.reports, experiment.drives, experiment.facts),
      experiment.drives);
  EXPECT_EQ(summary.collisions, 0U);
  for (const result::VehicleSummary& vehicle : summary.vehicles) {
    EXPECT_TRUE(vehicle.arrived_s) << vehicle.name;
  }
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    const auto& drive = experiment.drives.at(vehicle.id.value);
    ASSERT_FALSE(drive.empty());
    EXPECT_TRUE(contains(vehicle.goal->area_m, drive.back().pose.position_m())) << vehicle.name;
  }
}

class Samples : public testing::TestWithParam<test::CommonRoadSample> {};

TEST_P(Samples, OfPlanningProblemsAreSolved) {
  const scenario::Scenario scenario = scenario_of(GetParam().xml);
  EXPECT_EQ(scenario.vehicles.size(), GetParam().problems);
  expect_solved(scenario);
}

INSTANTIATE_TEST_SUITE_P(CommonRoad, Samples, testing::ValuesIn(test::commonroad_samples()),
                         [](const auto& sample) { return sample.param.name; });

/// From a straight lane round a bend to a goal behind it.
std::string random_bend(std::uint64_t seed) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
  const auto draw = [&random](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  const Pose origin{draw(-500.0, 500.0), draw(-500.0, 500.0), draw(-3.0, 3.0)};
  const double side = seed % 2 == 0 ? 1.0 : -1.0;
  const double turned_rad = side * draw(0.3, 2.0);
  const test::Line curve =
      test::arc(compose(origin, {20.0, 0.0, 0.0}), draw(15.0, 50.0), turned_rad);
  const Pose end = curve.back();
  const Pose start = compose(origin, {draw(5.0, 15.0), draw(-0.5, 0.5), draw(-0.1, 0.1)});
  const Pose goal = compose(end, {draw(12.0, 30.0), 0.0, 0.0});
  test::CommonRoadSketch sketch;
  sketch.lane(1, test::straight(origin.position_m(), curve.front().position_m()))
      .lane(2, curve)
      .lane(3, test::straight(end.position_m(), transformed(Point(45.0, 0.0), end)))
      .joined(1, 2)
      .joined(2, 3)
      .problem(7, start, {test::rectangle_at(goal, {draw(8.0, 15.0), 3.0})});
  return sketch.xml();
}

TEST(RandomCommonRoad, ProblemsOnABendAreSolved) {
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(20); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_solved(scenario_of(random_bend(seed)));
  }
}

// Found by the long form of the test above: each plan stood, and moved at its end, and so did the
// next one.
TEST(RandomCommonRoad, AreSolvedThoughEveryPlanInTheGoalMovesAtItsEnd) {
  for (const std::uint64_t seed : {132U, 138U, 160U, 164U}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_solved(scenario_of(random_bend(seed)));
  }
}

}  // namespace
}  // namespace hlc::closed_loop::commonroad_test
