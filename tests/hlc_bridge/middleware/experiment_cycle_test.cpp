#include "hlc_bridge/middleware/experiment_cycle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hlc_bridge/middleware/middleware_in_memory.hpp"

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::middleware {
namespace {

using test::run_parameters;

class ExperimentCycleTest : public testing::Test {
 protected:
  void ready(ExperimentCycle& cycle, std::uint8_t id) {
    cycle.take(ReadyStatus{.source_id = controller_ready_id(id)});
  }
  /// All actions of the next period.
  MiddlewareActions period(ExperimentCycle& cycle) {
    now_ += 2 * kNanosecondsPerSecond;
    MiddlewareActions actions;
    cycle.prepare_next(now_, actions);
    cycle.forward_goals(actions);
    cycle.announce_readiness(now_, actions);
    return actions;
  }
  template <class Kind>
  static std::size_t count(const MiddlewareActions& actions) {
    std::size_t count = 0;
    for (const MiddlewareAction& action : actions) count += std::holds_alternative<Kind>(action);
    return count;
  }

  Nanoseconds now_{};
};

TEST_F(ExperimentCycleTest, OfGoalsWithoutEndTheFirstAreForwarded) {
  ExperimentCycle cycle{{1}, kListOffset, false};
  for (std::size_t i = 0; i < 2 * ExperimentCycle::kMostGoals; ++i) cycle.take(GoalState{});
  ready(cycle, 1);
  EXPECT_EQ(count<GoalState>(period(cycle)), ExperimentCycle::kMostGoals);
  cycle.take(GoalState{});
  EXPECT_EQ(count<GoalState>(period(cycle)), 0U);
}

TEST_F(ExperimentCycleTest, AnnouncesReadinessOnceAllControllersAreReadyUntilTheTrigger) {
  ExperimentCycle cycle{{1, 2}, kListOffset, false};
  ASSERT_EQ(cycle.begin(run_parameters(200, {1, 2})), "");
  ready(cycle, 1);
  ready(cycle, 3);
  cycle.take(ReadyStatus{.source_id = "hlc_"});
  EXPECT_EQ(count<ReadyStatus>(period(cycle)), 0U);
  ready(cycle, 2);
  for (int i = 0; i < 3; ++i) {
    const MiddlewareActions actions = period(cycle);
    ASSERT_EQ(actions.size(), 1U);
    EXPECT_EQ(std::get<ReadyStatus>(actions[0]).source_id, "MW for muCars 1, 2 ready.");
    EXPECT_EQ(std::get<ReadyStatus>(actions[0]).next_start, 0U);
  }
  EXPECT_FALSE(cycle.is_triggered());
  cycle.take(SystemTrigger{5});
  EXPECT_TRUE(cycle.is_triggered());
  EXPECT_TRUE(period(cycle).empty());
}

TEST_F(ExperimentCycleTest, LogsNowAndThenForWhomItWaits) {
  ExperimentCycle cycle{{1, 2}, kListOffset, false};
  ASSERT_EQ(cycle.begin(run_parameters(200, {1, 2})), "");
  ready(cycle, 1);
  EXPECT_TRUE(period(cycle).empty());
  const MiddlewareActions actions = period(cycle);
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_EQ(std::get<machine::LogLine>(actions[0]),
            machine::info("waiting for high_level_controller_2 to be ready"));
  EXPECT_TRUE(period(cycle).empty());
}

TEST_F(ExperimentCycleTest, WithholdsGoalsUntilAllControllersAreReady) {
  ExperimentCycle cycle{{1, 2}, kListOffset, false};
  cycle.take(GoalState{.payload = 1});
  cycle.take(GoalState{.payload = 2});
  ready(cycle, 1);
  EXPECT_EQ(count<GoalState>(period(cycle)), 0U);
  ready(cycle, 2);
  MiddlewareActions actions;
  cycle.forward_goals(actions);
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_EQ(std::any_cast<int>(std::get<GoalState>(actions[0]).payload), 1);
  EXPECT_EQ(std::any_cast<int>(std::get<GoalState>(actions[1]).payload), 2);
  EXPECT_EQ(count<GoalState>(period(cycle)), 0U);
  cycle.take(GoalState{.payload = 3});
  EXPECT_EQ(count<GoalState>(period(cycle)), 1U);
}

TEST_F(ExperimentCycleTest, TheStopSymbolEndsTheProcess) {
  ExperimentCycle cycle{{1}, kListOffset, false};
  ASSERT_EQ(cycle.begin(run_parameters(200, {1})), "");
  cycle.take(SystemTrigger{5});
  EXPECT_FALSE(cycle.withholds_commands());
  cycle.take(SystemTrigger{kStopSymbol});
  EXPECT_TRUE(cycle.is_stopped());
  EXPECT_TRUE(cycle.withholds_commands());
  EXPECT_TRUE(period(cycle).empty());
}

TEST_F(ExperimentCycleTest, KeptRunningItNeedsReadyControllersAndTheNextParametersAnew) {
  ExperimentCycle cycle{{1}, kListOffset, true};
  ASSERT_EQ(cycle.begin(run_parameters(200, {1, 2})), "");
  ready(cycle, 1);
  cycle.take(Parameter{.name = kActiveIdsParameter, .value = std::vector<std::int32_t>{1, 9}});
  cycle.take(SystemTrigger{5});
  cycle.take(SystemTrigger{kStopSymbol});
  EXPECT_FALSE(cycle.is_stopped());
  EXPECT_FALSE(cycle.is_triggered());
  EXPECT_TRUE(cycle.withholds_commands());
  EXPECT_EQ(count<ParameterRequest>(period(cycle)), 2U);

  ready(cycle, 1);
  EXPECT_EQ(count<ReadyStatus>(period(cycle)), 0U) << "parameters are not known yet";
  cycle.take(Parameter{.name = kPeriodParameter, .value = std::uint64_t{200}});
  cycle.take(Parameter{.name = kActiveIdsParameter, .value = std::vector<std::int32_t>{1, 2, 5}});
  MiddlewareActions actions;
  cycle.prepare_next(now_, actions);
  cycle.announce_readiness(now_, actions);
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_EQ(std::get<SubscribeToVehicles>(actions[0]).vehicle_ids,
            (std::vector<std::int32_t>{1, 2, 5}));
  EXPECT_EQ(count<ReadyStatus>(actions), 1U);
  EXPECT_EQ(cycle.parameters().active_ids(), (std::vector<std::int32_t>{1, 2, 5}));

  cycle.take(SystemTrigger{6});
  EXPECT_TRUE(cycle.is_triggered());
  EXPECT_FALSE(cycle.withholds_commands());
  EXPECT_TRUE(period(cycle).empty());
}

TEST_F(ExperimentCycleTest, DoesNotAnnounceAnExperimentThatItCannotServe) {
  ExperimentCycle cycle{{1}, kListOffset, true};
  ASSERT_EQ(cycle.begin(run_parameters(200, {1, 2})), "");
  cycle.take(SystemTrigger{kStopSymbol});
  ready(cycle, 1);
  period(cycle);
  cycle.take(Parameter{.name = kPeriodParameter, .value = std::uint64_t{200}});
  cycle.take(Parameter{.name = kActiveIdsParameter, .value = std::vector<std::int32_t>{2}});
  MiddlewareActions actions;
  cycle.prepare_next(now_, actions);
  cycle.announce_readiness(now_, actions);
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_EQ(std::get<machine::LogLine>(actions[0]).severity, machine::Severity::kError);
  EXPECT_EQ(cycle.parameters().active_ids(), (std::vector<std::int32_t>{1, 2}));
}

TEST_F(ExperimentCycleTest, RefusesAFirstExperimentThatItCannotServe) {
  ExperimentCycle cycle{{1}, kListOffset, false};
  EXPECT_NE(cycle.begin(run_parameters(200, {2, 3})), "");
  EXPECT_FALSE(cycle.has_begun());
  EXPECT_EQ(cycle.begin(run_parameters(200, {1, 3})), "");
  EXPECT_TRUE(cycle.has_begun());
}

}  // namespace
}  // namespace hlc::middleware
