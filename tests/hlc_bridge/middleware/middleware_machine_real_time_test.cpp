// The machine without waits: lists by the clock, with any participants.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/validate.hpp"
#include "hlc_bridge/middleware/middleware_machine.hpp"
#include "tests/hlc_bridge/middleware/middleware_in_memory.hpp"

namespace hlc::middleware {
namespace {

using test::command;
using test::kMs;
using test::kPeriod;
using testing::ElementsAre;

class ImpatientMiddlewareTest : public testing::Test {
 protected:
  explicit ImpatientMiddlewareTest(bool keep_running = false)
      : run_{{.vehicle_ids = {1},
              .keep_running = keep_running,
              .startup_timeout = 30 * kNanosecondsPerSecond,
              .rules = real_middleware_rules(false)}} {
    run_.publish_parameters(200, {1, 2});
    run_.on(run_.all_present({1, 2}));
    pass_period();
    run_.forget_actions();
  }

  void pass_period() {
    ASSERT_TRUE(run_.machine().wake_up().run);
    run_.pass(*run_.machine().wake_up().run - run_.now().run);
  }
  void pass_periods(Nanoseconds time) {
    for (Nanoseconds passed = 0; passed < time; passed += kPeriod) pass_period();
  }
  void controller_ready() { run_.on(ReadyStatus{.source_id = controller_ready_id(1)}); }
  [[nodiscard]] std::vector<Nanoseconds> list_times() const {
    std::vector<Nanoseconds> times;
    for (const VehicleStateList& list : run_.all<VehicleStateList>()) times.push_back(list.t_now);
    return times;
  }
  [[nodiscard]] MiddlewarePeers without_lab_control() const {
    MiddlewarePeers peers = run_.all_present({1, 2});
    peers.lab_control_is_lost = true;
    return peers;
  }

  test::MiddlewareInMemory run_;
};

TEST_F(ImpatientMiddlewareTest, ListsComeByTheClockWhoeverIsThere) {
  run_.on(MiddlewarePeers{});
  const Nanoseconds first = run_.now().run;
  EXPECT_EQ(first % kPeriod, kListOffset);
  for (int i = 0; i < 3; ++i) pass_period();
  EXPECT_THAT(list_times(), ElementsAre(first + kPeriod, first + 2 * kPeriod, first + 3 * kPeriod));
}

TEST_F(ImpatientMiddlewareTest, ALateListIsGivenLateAndOlderOnesAreSkipped) {
  const Nanoseconds first = run_.now().run;
  run_.pass(kPeriod + 150 * kMs);
  run_.advance();
  run_.pass(3 * kPeriod - 100 * kMs);
  EXPECT_THAT(list_times(), ElementsAre(first + kPeriod, first + 4 * kPeriod));
  EXPECT_EQ(run_.machine().wake_up().run, first + 5 * kPeriod);
}

TEST_F(ImpatientMiddlewareTest, TellsTheLabControlEveryPeriodUntilTheTrigger) {
  pass_period();
  EXPECT_TRUE(run_.all<ReadyStatus>().empty());
  controller_ready();
  pass_period();
  pass_period();
  ASSERT_EQ(run_.all<ReadyStatus>().size(), 2U);
  EXPECT_EQ(run_.all<ReadyStatus>()[0].source_id, "MW for muCars 1 ready.");
  run_.on(SystemTrigger{5});
  pass_period();
  EXPECT_EQ(run_.all<ReadyStatus>().size(), 2U);
}

TEST_F(ImpatientMiddlewareTest, ForwardsCommandsAndTriggersBetweenTheTicks) {
  const Nanoseconds list = run_.now().run;
  run_.pass(10 * kMs);
  run_.on(command(1, list));
  run_.on(SystemTrigger{5});
  run_.on(SystemTrigger{6});
  EXPECT_EQ(run_.all<VehicleCommand>().size(), 1U);
  EXPECT_EQ(run_.all<SystemTrigger>().size(), 2U);
  EXPECT_TRUE(run_.all<machine::LogLine>().empty());
  EXPECT_TRUE(run_.all<VehicleStateList>().empty());
}

TEST_F(ImpatientMiddlewareTest, ChecksCommandsAgainstTheNewestListAndTheClock) {
  const Nanoseconds list = run_.now().run;
  pass_period();
  run_.on(command(1, list));
  EXPECT_EQ(run_.count_lines("missed the current period"), 1U);
  run_.on(command(1, run_.now().run + 1));
  EXPECT_EQ(run_.count_lines("create_stamp lies in the future"), 1U);
  run_.on(command(1, list));
  EXPECT_EQ(run_.count_lines("logged once"), 2U);
  EXPECT_EQ(run_.all<VehicleCommand>().size(), 3U);
}

TEST_F(ImpatientMiddlewareTest, ListsShowAVehicleWhoseBufferWouldBeFullOfStatesOfTheFuture) {
  const Nanoseconds hour = 3600 * kNanosecondsPerSecond;
  const Nanoseconds now = run_.now().run;
  run_.on(test::published_state(1, now));
  for (std::size_t i = 0; i < StateBuffer::kCapacity; ++i) {
    PublishedState forged = test::published_state(1, now + hour + i);
    if (i % 2 == 0) forged.state.create_stamp = now;
    run_.post(forged);
  }
  pass_period();
  ASSERT_EQ(run_.all<VehicleStateList>().size(), 1U);
  EXPECT_EQ(run_.all<VehicleStateList>()[0].states.at(0).create_stamp, now);
  EXPECT_EQ(run_.count_lines("state of " + vehicle_name(1) + " dropped: stamp must be <="), 1U);
  run_.on(test::published_state(2, ~Nanoseconds{}));
  EXPECT_EQ(run_.count_lines("state of " + vehicle_name(2) + " dropped: stamp must be <="), 1U);
  run_.on(PublishedObservation{.vehicle_id = 2, .observation = {.create_stamp = now + hour}});
  EXPECT_EQ(run_.count_lines("observation of " + vehicle_name(2) + " dropped: stamp must be <="),
            1U);
  run_.on(machine::StopSignal{});
  EXPECT_EQ(run_.count_lines("2002 messages dropped because of their stamps"), 1U);
}

TEST_F(ImpatientMiddlewareTest, ListsHoldStatesAndAnswersCountThatAreALittleEarly) {
  run_.on(test::published_state(1, run_.now().run + kMostLead - kStateDelay));
  run_.on(command(1, run_.now().run + kMostLead));
  EXPECT_EQ(run_.count_lines("dropped"), 0U);
  EXPECT_EQ(run_.all<VehicleCommand>().size(), 1U);
}

TEST_F(ImpatientMiddlewareTest, ACommandStampedFarAheadIsNeitherForwardedNorAnAnswer) {
  run_.on(SystemTrigger{5});
  run_.on(command(1, ~Nanoseconds{}));
  EXPECT_TRUE(run_.all<VehicleCommand>().empty());
  EXPECT_EQ(run_.count_lines("command of high_level_controller_1 dropped"), 1U);
  pass_period();
  pass_period();
  EXPECT_EQ(run_.count_lines("no answer of high_level_controller_1 to a state list"), 1U);
}

TEST_F(ImpatientMiddlewareTest, CountsMissedAnswersFromTheTriggerOn) {
  pass_period();
  run_.on(SystemTrigger{5});
  run_.on(command(1, run_.now().run));
  pass_period();
  EXPECT_EQ(run_.count_lines("to a state list in time"), 0U);
  pass_period();
  pass_period();
  EXPECT_EQ(run_.count_lines("no answer of high_level_controller_1 to a state list"), 1U);
  run_.on(machine::StopSignal{});
  EXPECT_EQ(run_.count_lines("2 lists without an answer in time"), 1U);
  EXPECT_EQ(run_.machine().exit_code(), kExitGood);
}

TEST_F(ImpatientMiddlewareTest, CountsNoListFromBeforeTheTriggersTime) {
  run_.on(SystemTrigger{run_.now().run + 2 * kPeriod});
  for (int i = 0; i < 2; ++i) pass_period();
  EXPECT_EQ(run_.count_lines("to a state list in time"), 0U);
  for (int i = 0; i < 2; ++i) pass_period();
  EXPECT_EQ(run_.count_lines("to a state list in time"), 1U);
}

TEST_F(ImpatientMiddlewareTest, StaysForAWhileWithoutTheLabControl) {
  run_.on(without_lab_control());
  pass_periods(kMiddlewareStays - kPeriod);
  EXPECT_FALSE(run_.machine().exit_code());
  EXPECT_GE(list_times().size(), 18U) << "the controller needs lists until its car stands";
  pass_period();
  EXPECT_EQ(run_.machine().exit_code(), kExitDied);
}

TEST_F(ImpatientMiddlewareTest, ALabControlThatComesBackIsNotLost) {
  run_.on(without_lab_control());
  pass_periods(kMiddlewareStays - kPeriod);
  run_.on(run_.all_present({1, 2}));
  pass_period();
  run_.on(without_lab_control());
  pass_periods(kMiddlewareStays - kPeriod);
  EXPECT_FALSE(run_.machine().exit_code());
}

TEST_F(ImpatientMiddlewareTest, TheStopSymbolIsForwardedAndEndsIt) {
  run_.on(SystemTrigger{5});
  run_.on(SystemTrigger{kStopSymbol});
  EXPECT_EQ(run_.all<SystemTrigger>().back().next_start, kStopSymbol);
  run_.wait(MiddlewareMachine::kLeaveTime);
  EXPECT_EQ(run_.machine().exit_code(), kExitGood);
}

class KeptRunningMiddlewareTest : public ImpatientMiddlewareTest {
 protected:
  KeptRunningMiddlewareTest() : ImpatientMiddlewareTest{true} {}
};

TEST_F(KeptRunningMiddlewareTest, ServesTheNextExperimentWithItsVehicles) {
  controller_ready();
  run_.on(SystemTrigger{5});
  run_.on(command(1, run_.now().run));
  EXPECT_EQ(run_.all<VehicleCommand>().size(), 1U);
  run_.on(SystemTrigger{kStopSymbol});
  pass_period();
  EXPECT_FALSE(run_.machine().exit_code());
  EXPECT_EQ(run_.all<ParameterRequest>().size(), 2U);
  run_.on(command(1, run_.now().run));
  EXPECT_EQ(run_.all<VehicleCommand>().size(), 1U) << "kept back between experiments";

  controller_ready();
  pass_period();
  EXPECT_TRUE(run_.all<ReadyStatus>().empty()) << "the next experiment is not known yet";
  run_.publish_parameters(200, {1, 2, 5});
  pass_period();
  EXPECT_EQ(run_.all<ReadyStatus>().size(), 1U);
  EXPECT_THAT(run_.all<SubscribeToVehicles>().back().vehicle_ids, ElementsAre(1, 2, 5));
  EXPECT_THAT(run_.all<VehicleStateList>().back().active_vehicle_ids, ElementsAre(1, 2, 5));

  run_.on(SystemTrigger{6});
  run_.on(command(1, run_.now().run));
  EXPECT_EQ(run_.all<VehicleCommand>().size(), 2U);
  EXPECT_EQ(run_.all<SystemTrigger>().size(), 3U);
}

TEST_F(KeptRunningMiddlewareTest, AskedForTheNextExperimentEverySecondOfWallTime) {
  run_.on(SystemTrigger{kStopSymbol});
  pass_periods(10 * kNanosecondsPerSecond);
  EXPECT_EQ(run_.all<ParameterRequest>().size(), 20U);
}

TEST_F(KeptRunningMiddlewareTest, AStopDuringTheStartDoesNotHideTheParameters) {
  test::MiddlewareInMemory run{
      {.vehicle_ids = {1}, .keep_running = true, .rules = real_middleware_rules(false)}};
  run.on(SystemTrigger{kStopSymbol});
  run.publish_parameters(200, {1});
  EXPECT_TRUE(run.machine().wake_up().run);
}

}  // namespace
}  // namespace hlc::middleware
