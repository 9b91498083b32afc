// Whole runs of vehicles that are not the lab's: simulated by their limits, on their roads.
#include <gtest/gtest.h>

#include "hlc_bridge/result/planned_motion.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::closed_loop::own_vehicle_test {
namespace {

double driven_m(const result::Drive& drive) {
  double way_m = 0.0;
  for (std::size_t i = 1; i < drive.size(); ++i) {
    way_m += (drive[i].pose.position_m() - drive[i - 1].pose.position_m()).norm();
  }
  return way_m;
}

class OwnVehicleRuns : public ::testing::TestWithParam<std::string> {};

TEST_P(OwnVehicleRuns, StayWithinTheirSafetyMarginAndTouchNobody) {
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(3); ++seed) {
    SCOPED_TRACE(seed);
    const scenario::Scenario scenario = scenario::read_scenario(
        {.file = test::source_folder() + "/launch_scripts/scenarios/" + GetParam() + ".yaml"});
    const Experiment experiment =
        drive_experiment(scenario, {.steps = scenario.steps, .noise_seed = seed});
    EXPECT_EQ(experiment.facts.exit_code, 0) << experiment.facts.reason;
    const std::vector<result::StepRecord> rows =
        result::step_records(experiment.reports, experiment.drives, experiment.facts);
    const result::RunSummary summary = result::summarize(result::describe(scenario, seed),
                                                         experiment.facts, rows, experiment.drives);
    EXPECT_EQ(summary.collisions, 0U);
    const double length_m = scenario.subgraph->automaton().vehicle.footprint.length_m;
    const double margin_m = scenario.subgraph->automaton().vehicle.safety_margin_m;
    for (const result::VehicleSummary& vehicle : summary.vehicles) {
      ASSERT_TRUE(vehicle.deviation_max_m);
      EXPECT_LE(*vehicle.deviation_max_m, margin_m);
      EXPECT_FALSE(vehicle.is_stuck);
      EXPECT_GT(driven_m(experiment.drives.at(vehicle.id.value)), 10.0 * length_m);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, OwnVehicleRuns,
                         ::testing::Values("passenger_cars", "passenger_cars_in_town",
                                           "f1tenth_in_town"),
                         [](const auto& scenario) { return scenario.param; });

}  // namespace
}  // namespace hlc::closed_loop::own_vehicle_test
