// When the machine of a controller is ready, begins, goes on without the others, and ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "tests/hlc_bridge/hlc/driven_machine.hpp"

namespace hlc::high_level_controller::hlc_machine_life_cycle_test {
namespace {

using namespace driven_machine;
using controller::east_bound::seen;
using testing::IsEmpty;
using testing::SizeIs;

coordination::StepStatus last_status(DrivenMachine& one) {
  const std::vector<ReportRecord> records = one.take<ReportRecord>();
  EXPECT_THAT(records, testing::Not(IsEmpty()));
  return records.empty() ? coordination::StepStatus::kStandby : records.back().report.status;
}

coordination::Traffic traffic_of(std::uint8_t vehicle, std::uint64_t step) {
  coordination::Traffic traffic;
  traffic.vehicle = {vehicle};
  traffic.step = {step};
  return traffic;
}

// --- ready ---------------------------------------------------------------------------------------

TEST(HlcMachineReady, SaysSoEveryHalfSecondUntilTheStartOnceItsVehicleMayBeToldToStand) {
  DrivenMachine one(real_time());
  one.on(peers());
  for (int i = 0; i < 7; ++i) one.next_list(standing());
  EXPECT_THAT(one.take<ReadyStatus>(), IsEmpty());
  EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty()) << "its plan may be to wait and drive";
  one.next_list(standing());
  ASSERT_THAT(one.take<ReadyStatus>(), SizeIs(1));
  EXPECT_TRUE(one.has_logged("ready; waiting for the start trigger"));
  one.pass(kSecond);
  EXPECT_THAT(one.take<ReadyStatus>(), SizeIs(2));
  one.on(SystemTrigger{.next_start = 1});
  one.pass(kSecond);
  EXPECT_THAT(one.take<ReadyStatus>(), IsEmpty());
}

TEST(HlcMachineReady, WaitsForAllWhoAreToReceiveWhatItPublishesAndNamesThem) {
  DrivenMachine one(real_time());
  const std::vector<coordination::MeasuredVehicle> both{seen(1, 0.0, 0.0), seen(2, 0.0, 5.0)};
  one.on(peers());
  stand(one, both);
  one.pass(kSecond);
  EXPECT_THAT(one.take<ReadyStatus>(), IsEmpty());
  EXPECT_TRUE(one.has_logged("waiting: missing: high_level_controller_2"));
  one.on(peers({2}));
  EXPECT_THAT(one.take<ReadyStatus>(), SizeIs(1));
}

TEST(HlcMachineReady, LeavesAfterTheStartupTimeoutAndSaysWhoIsMissing) {
  DrivenMachine without_lists(real_time());
  without_lists.pass(30 * kSecond);
  EXPECT_FALSE(without_lists.exit_code());
  without_lists.pass(1);
  EXPECT_EQ(without_lists.exit_code(), kExitMissing);
  EXPECT_TRUE(without_lists.has_logged("no state list received from the middleware within 30 s"));

  DrivenMachine without_readers(real_time());
  without_readers.next_list(standing());
  without_readers.pass(31 * kSecond);
  EXPECT_EQ(without_readers.exit_code(), kExitMissing);
  EXPECT_TRUE(without_readers.has_logged("missing: the middleware's reader of commands"));
}

TEST(HlcMachineReady, InLogicalTimeTheFirstListIsAnsweredWhenEverybodyIsThere) {
  DrivenMachine one(logical_time());
  const std::vector<coordination::MeasuredVehicle> both{seen(1, 0.0, 0.0), seen(2, 0.0, 5.0)};
  one.on(peers());
  one.next_list(both);
  one.pass(5 * kSecond);
  EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty());
  one.on(peers({2}));
  EXPECT_THAT(one.take<TrajectoryCommand>(), SizeIs(2)) << "with its copy";
  EXPECT_EQ(last_status(one), coordination::StepStatus::kStandby);
  EXPECT_THAT(one.take<ReadyStatus>(), SizeIs(1));

  DrivenMachine alone(logical_time());
  alone.on(peers());
  alone.next_list(both);
  alone.pass(31 * kSecond);
  EXPECT_EQ(alone.exit_code(), kExitMissing);
}

// --- duplicate instances -------------------------------------------------------------------------

HlcPeers with_duplicate() {
  HlcPeers result = peers();
  result.lab.alive.insert(controller_name(1));
  return result;
}

TEST(HlcMachineDuplicate, TheSecondInstancePublishesNothingAndLeaves) {
  for (const HlcRules& rules : {real_time(), logical_time()}) {
    DrivenMachine one(rules);
    one.on(with_duplicate());
    for (int i = 0; i < 12; ++i) one.next_list(standing());
    one.pass(rules.duplicate_patience);
    EXPECT_EQ(one.exit_code(), kExitBadInput);
    EXPECT_TRUE(one.has_logged("another instance of high_level_controller_1 is running; stop it"));
    EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty());
    EXPECT_THAT(one.take<ReadyStatus>(), IsEmpty());
    EXPECT_THAT(one.take<coordination::Traffic>(), IsEmpty());
  }
}

TEST(HlcMachineDuplicate, ADeadInstancesTraceIsOnlyWaitedFor) {
  DrivenMachine one(real_time());
  one.on(with_duplicate());
  stand(one);
  EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty());
  one.on(peers());
  one.next_list(standing());
  EXPECT_THAT(one.take<ReadyStatus>(), SizeIs(1));
  one.pass(10 * kSecond);
  EXPECT_FALSE(one.exit_code());
}

TEST(HlcMachineDuplicate, WhoIsReadyStaysUntilAnotherOneSpeaksForItsVehicle) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  one.on(with_duplicate());
  for (int i = 0; i < 30; ++i) one.next_list(standing());
  EXPECT_FALSE(one.exit_code());
  EXPECT_THAT(one.take<ReportRecord>(), SizeIs(30));
  one.on(traffic_of(1, one.step()));
  EXPECT_EQ(one.exit_code(), kExitBadInput);
}

// --- the start -----------------------------------------------------------------------------------

TEST(HlcMachineStart, DrivesFromTheFirstListAfterTheTriggersTimeOn) {
  DrivenMachine one(real_time());
  one.on(peers());
  stand(one);
  one.on(SystemTrigger{.next_start = one.now().run + 2 * kPeriod});
  one.next_list(standing());
  EXPECT_EQ(last_status(one), coordination::StepStatus::kStandby);
  one.next_list(standing());
  one.next_list(standing());
  EXPECT_EQ(last_status(one), coordination::StepStatus::kPlanned);
  EXPECT_FALSE(one.has_logged("joining"));
}

TEST(HlcMachineStart, JoinsARunningExperimentByTheOthersTraffic) {
  DrivenMachine one(real_time());
  const std::vector<coordination::MeasuredVehicle> both{seen(1, 0.0, 0.0), seen(2, 0.0, 5.0)};
  one.on(peers());
  stand(one, both);
  one.on(traffic_of(2, one.step() - 3));
  one.on(traffic_of(3, one.step() + 1));
  one.next_list(both);
  EXPECT_EQ(last_status(one), coordination::StepStatus::kStandby)
      << "of another time, or of no driving vehicle";
  one.on(traffic_of(2, one.step()));
  one.next_list(both);  // ready now, though 2 receives nothing of it
  one.pass(kPeriod / 2);
  one.next_list(both);
  one.pass(kPeriod / 2);
  EXPECT_EQ(last_status(one), coordination::StepStatus::kPlanned);
  EXPECT_TRUE(one.has_logged("joining the running experiment"));
}

TEST(HlcMachineStart, JoinsARunningExperimentByWhatTheLabControlSays) {
  DrivenMachine one(real_time());
  one.on(peers());
  one.on(RunState{.phase = RunPhase::kRunning, .start = kPeriod});
  stand(one);
  EXPECT_EQ(last_status(one), coordination::StepStatus::kPlanned);
  EXPECT_TRUE(one.has_logged("joining the running experiment"));
}

// --- losses --------------------------------------------------------------------------------------

HlcPeers without_middleware() {
  HlcPeers result = peers();
  result.command_readers = 0;
  result.local.lost = {middleware_name(1)};
  return result;
}

TEST(HlcMachineLoss, PlansOnWhenItsMiddlewareIsBack) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  one.next_list(standing());
  one.on(without_middleware());
  EXPECT_TRUE(one.has_logged("middleware_1 lost"));
  one.pass(30 * kSecond);
  EXPECT_FALSE(one.exit_code());
  EXPECT_TRUE(one.has_logged("waiting: no state list from middleware_1 for"));
  one.on(peers());
  EXPECT_TRUE(one.has_logged("middleware_1 is back"));
  one.forget();
  one.next_list(standing());
  EXPECT_EQ(last_status(one), coordination::StepStatus::kPlanned);
}

TEST(HlcMachineLoss, LeavesWhenItsMiddlewareStaysAway) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  one.on(without_middleware());
  one.pass(30 * kSecond + 1);
  EXPECT_EQ(one.exit_code(), kExitDied);
}

TEST(HlcMachineLoss, LeavesWithoutItsMiddlewareAtOnceWhenEverybodyDrivesOutOrTimeStandsStill) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  one.on(RunState{.phase = RunPhase::kMinimalRiskStop});
  EXPECT_FALSE(one.exit_code());
  one.on(without_middleware());
  EXPECT_EQ(one.exit_code(), kExitDied);

  DrivenMachine other(logical_time());
  other.on(peers());
  other.next_list(standing());
  other.on(without_middleware());
  EXPECT_EQ(other.exit_code(), kExitDied);
}

TEST(HlcMachineLoss, DrivesOutWithoutLabControlAndPlansOnWhenItIsBackInTime) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  HlcPeers alone = peers();
  alone.lab = {.alive = {}, .lost = {kLabControlName}};
  one.on(alone);
  EXPECT_TRUE(one.has_logged("lab_control lost"));
  one.next_list(standing());
  EXPECT_EQ(last_status(one), coordination::StepStatus::kMinimalRiskStop);
  one.on(peers());
  EXPECT_TRUE(one.has_logged("lab_control is back"));
  one.next_list(standing());
  EXPECT_EQ(last_status(one), coordination::StepStatus::kPlanned);

  alone.lab.lost = {};  // the lab's own bears no name of ours, but reads stop requests
  alone.stop_request_readers = 0;
  one.on(alone);
  one.pass(machine::LabControlWatch::kGap);
  one.next_list(standing());
  EXPECT_EQ(last_status(one), coordination::StepStatus::kMinimalRiskStop);
  one.pass(kControllerStays);
  EXPECT_EQ(one.exit_code(), kExitDied);
}

// --- the end -------------------------------------------------------------------------------------

TEST(HlcMachineEnd, AfterTheStopSymbolTheVehicleHearsNothing) {
  DrivenMachine one(real_time_in_the_lab());
  one.on(peers());
  start(one);
  one.next_list(standing());
  ASSERT_THAT(one.take<TrajectoryCommand>(), SizeIs(1)) << "its copy waits";
  one.on(SystemTrigger{.next_start = kStopSymbol});
  EXPECT_EQ(one.exit_code(), kExitGood);
  EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty());
}

TEST(HlcMachineEnd, ToldToEndItLeavesTheVehicleTheCopyOfItsLastCommand) {
  DrivenMachine one(real_time_in_the_lab());
  one.on(peers());
  start(one);
  one.next_list(standing());
  const std::vector<TrajectoryCommand> commands = one.take<TrajectoryCommand>();
  ASSERT_THAT(commands, SizeIs(1));
  one.on(machine::StopSignal{});
  EXPECT_FALSE(one.exit_code()) << "the reader of the lab's middleware keeps one command";
  one.pass(CommandCopies::kPause);
  EXPECT_EQ(one.exit_code(), kExitGood);
  const std::vector<TrajectoryCommand> copies = one.take<TrajectoryCommand>();
  ASSERT_THAT(copies, SizeIs(1));
  EXPECT_EQ(copies[0].create_stamp, commands[0].create_stamp);
  EXPECT_EQ(copies[0].valid_after_stamp, commands[0].valid_after_stamp + kCopyDelay);
}

TEST(HlcMachineEnd, AStopSymbolThatComesWhileTheCopyWaitsDropsIt) {
  DrivenMachine one(real_time_in_the_lab());
  one.on(peers());
  start(one);
  one.next_list(standing());
  one.on(machine::StopSignal{});
  one.forget();
  one.on(SystemTrigger{.next_start = kStopSymbol});
  EXPECT_EQ(one.exit_code(), kExitGood);
  EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty());
}

TEST(HlcMachineEnd, AStepThatIsUnderWayEndsAtOnceAndWithoutACommand) {
  for (const HlcEvent& stop :
       {HlcEvent{SystemTrigger{.next_start = kStopSymbol}}, HlcEvent{machine::StopSignal{}}}) {
    DrivenMachine one(real_time());
    const std::vector<coordination::MeasuredVehicle> both{seen(1, 0.0, 0.0), seen(2, 0.0, 5.0)};
    one.on(peers({2}));
    start(one, both);
    one.next_list(both);
    ASSERT_THAT(one.take<coordination::Traffic>(), SizeIs(1));
    ASSERT_THAT(one.take<ReportRecord>(), IsEmpty());
    one.on(stop);
    EXPECT_EQ(one.exit_code(), kExitGood);
    EXPECT_THAT(one.take<ReportRecord>(), SizeIs(1));
    EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty());
  }
}

TEST(HlcMachineEnd, AsksForTheStopOfAllWhenTheLabsPeriodIsNotItsStep) {
  VehicleStateList list = list_of(kFirstStep, standing());
  list.period_ms = 400;
  DrivenMachine one(real_time());
  one.on(peers());
  one.on(list);
  EXPECT_EQ(one.exit_code(), kExitBadInput);
  EXPECT_THAT(one.take<StopRequest>(), SizeIs(1));
  EXPECT_TRUE(one.has_logged("middleware period = 400 ms, must be the automaton's step of 0.2 s"));

  DrivenMachine unheard(real_time());
  unheard.on(list);
  EXPECT_FALSE(unheard.exit_code()) << "a lab control may appear";
  unheard.pass(kSecond);
  EXPECT_EQ(unheard.exit_code(), kExitBadInput);
  EXPECT_THAT(unheard.take<StopRequest>(), IsEmpty());
}

TEST(HlcMachineEnd, WhatTheOwnerCouldNotWriteIsSaidAndItsExitCode) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  one.next_list(standing());
  ASSERT_THAT(one.take<AfterStep>(), SizeIs(1));
  one.on(AfterStepFailure{"no space left"});
  EXPECT_TRUE(one.has_logged("on not written: no space left"));
  one.next_list(standing());
  EXPECT_THAT(one.take<AfterStep>(), IsEmpty());
  one.forget();
  one.on(SystemTrigger{.next_start = kStopSymbol});
  EXPECT_EQ(one.exit_code(), kExitNotWritten);
  EXPECT_TRUE(one.has_logged("no space left"));
}

TEST(HlcMachineEnd, APlanThatIsLongerThanACommandIsRefusedByNameValueAndBound) {
  controller::ControllerOptions options{.vehicle = {1}, .horizon_steps = 9};
  auto controller = std::make_unique<controller::Controller>(
      options, controller::east_bound::subgraph(),
      road::ReferencePath({Point(0.0, 0.0), Point(9.0, 0.0)}, false), road::Corridor{});
  try {
    const HlcMachine machine({.rules = real_time()}, std::move(controller));
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("horizon_steps must be <= 8, got 9"));
  }
}

}  // namespace
}  // namespace hlc::high_level_controller::hlc_machine_life_cycle_test
