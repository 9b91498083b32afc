#include "planner/rollout/priority_trial.hpp"

#include <gtest/gtest.h>

#include <string>

#include "planner/coordination/priorities/strategies.hpp"
#include "tests/support/folders.hpp"

namespace hlc::rollout::priority_trial_test {
namespace {

scenario::Scenario on_circle(const coordination::PriorityStrategy& strategy, std::size_t cars,
                             std::size_t steps) {
  scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/circle.yaml",
       .priorities = std::string(strategy.name),
       .steps = steps,
       .cars = cars});
  scenario.profile.strategies.coordination = controller::kStrictCoordination;
  return scenario;
}

/// A second for each call.
double counted_s() {
  static double now_s = 0.0;
  return now_s += 1.0;
}

TEST(PriorityTrial, OfTheOptimalOrderCostsWhatTheOptimalOrderDoes) {
  const PriorityTrial trial =
      try_priorities(on_circle(coordination::kOptimalPriorities, 3, 12), true, &counted_s);
  EXPECT_EQ(trial.compared_steps, 12U);
  EXPECT_EQ(trial.worse_steps, 0U);
  EXPECT_GT(trial.cost_m2, 0.0);
  EXPECT_DOUBLE_EQ(trial.cost_m2, trial.optimal_order_m2);
}

TEST(PriorityTrial, OfAnotherOrderCostsMore) {
  const PriorityTrial trial =
      try_priorities(on_circle(coordination::kRandomPriorities, 4, 15), true, &counted_s);
  EXPECT_GT(trial.compared_steps, 0U);
  EXPECT_GT(trial.cost_m2, trial.optimal_order_m2 * 1.001);
}

TEST(PriorityTrial, ComparesNothingThatIsTooLargeForTheOptimalOrder) {
  const PriorityTrial trial =
      try_priorities(on_circle(coordination::kConstantPriorities, 6, 5), true, &counted_s);
  EXPECT_EQ(trial.compared_steps, 0U);
  EXPECT_EQ(trial.gaps.size(), 5U) << "all six are coupled";
}

TEST(PriorityTrial, CountsStepsLevelsAndWay) {
  const PriorityTrial trial =
      try_priorities(on_circle(coordination::kConstantPriorities, 4, 10), false, &counted_s);
  EXPECT_EQ(trial.step_s, std::vector<double>(10, 1.0));
  EXPECT_EQ(trial.levels, std::vector<std::size_t>(10, 4));
  EXPECT_EQ(trial.vehicle_steps, 40U);
  EXPECT_EQ(trial.planned, 40U);
  EXPECT_GT(trial.driven_m, 1.0);
  EXPECT_EQ(trial.compared_steps, 0U);
  EXPECT_FALSE(trial.deadlock_step);
}

// At the opposite point a car stands for good: three horizons of eight steps later it counts.
TEST(PriorityTrial, CountsAVehicleThatStandsForThreeHorizons) {
  const PriorityTrial trial =
      try_priorities(on_circle(coordination::kConstantPriorities, 1, 60), false, &counted_s);
  ASSERT_TRUE(trial.deadlock_step);
  EXPECT_GE(*trial.deadlock_step, 24U);
}

}  // namespace
}  // namespace hlc::rollout::priority_trial_test
