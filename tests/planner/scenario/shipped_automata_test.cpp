// The shipped automata beside the paper's drive, with vehicles that follow perfectly.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "planner/automaton/maneuver_check.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/plans_in_force.hpp"

namespace hlc::scenario::shipped_automata_test {
namespace {

const std::string kScenarios = test::source_folder() + "/launch_scripts/scenarios/";

struct Shipped {
  std::string scenario;
  std::string subgraph;
  std::size_t steps;
  double path_m;  ///< that every vehicle has driven by then, at least
};
void PrintTo(const Shipped& one, std::ostream* out) { *out << one.scenario << "_" << one.subgraph; }

class ShippedAutomaton : public testing::TestWithParam<Shipped> {};

TEST_P(ShippedAutomaton, Drives) {
  const Scenario scenario = read_scenario(
      {.file = kScenarios + GetParam().scenario + ".yaml", .subgraph = GetParam().subgraph});
  for (const automaton::Maneuver& maneuver : scenario.subgraph->automaton().maneuvers) {
    ASSERT_EQ(automaton::validate(maneuver, scenario.subgraph->automaton()), "");
  }
  std::vector<std::unique_ptr<controller::Controller>> controllers;
  std::vector<Pose> starts;
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    controllers.push_back(make_controller(scenario, vehicle.id));
    starts.push_back(vehicle.start);
  }
  std::vector<Point> last;
  for (const Pose& start : starts) last.push_back(start.position_m());
  std::vector<double> driven_m(starts.size());
  rollout::Rollout rollout(std::move(controllers), starts);
  for (std::size_t step = 0; step < GetParam().steps; ++step) {
    for (const coordination::Report& report : rollout.step()) {
      ASSERT_EQ(report.status, coordination::StepStatus::kPlanned)
          << coordination::to_string(report.reason);
      const std::size_t i = report.vehicle.value - 1U;
      driven_m[i] += (report.planned_pose.position_m() - last[i]).norm();
      last[i] = report.planned_pose.position_m();
    }
    ASSERT_TRUE(test::plans_in_force_are_free(rollout)) << "step " << step;
  }
  for (const double way_m : driven_m) EXPECT_GT(way_m, GetParam().path_m);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, ShippedAutomaton,
                         testing::Values(Shipped{"grid_red_alone", "J2", 80, 11.0},
                                         Shipped{"lab_circle", "B", 22, 2.0},
                                         Shipped{"passenger_cars", "effort", 30, 65.0},
                                         Shipped{"passenger_cars", "comfort", 30, 65.0}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace hlc::scenario::shipped_automata_test
