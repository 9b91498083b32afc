// When the machine of a controller is ready, begins, and ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "planner/geometry/footprint.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/hlc_bridge/hlc/driven_machine.hpp"
#include "tests/support/folders.hpp"

namespace hlc::high_level_controller::hlc_machine_life_cycle_test {
namespace {

using namespace driven_machine;
using controller::east_bound::following;
using controller::east_bound::seen;
using machine::LabControlWatch;
using testing::Each;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;
using testing::SizeIs;

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
  for (int i = 0; i < 5; ++i) one.next_list(standing());
  EXPECT_THAT(one.take<ReportRecord>(), testing::Each(testing::Truly([](const auto& record) {
                return record.report.status == coordination::StepStatus::kStandby;
              })));
  one.take<ReadyStatus>();
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

TEST(HlcMachineReady, SaysThatItsVehicleFitsNoRouteAndIsNotReadyUntilItDoes) {
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/paper_red_alone.yaml"});
  const Pose start = scenario::measured_start(scenario, scenario.vehicles.front());
  DrivenMachine one(real_time(), scenario::make_controller(scenario, {1}));
  one.on(peers());
  for (int i = 0; i < 20; ++i) {
    one.next_list({{.vehicle = {1}, .pose = compose(start, {0.0, 0.0, 1.5})}});
  }
  EXPECT_TRUE(one.has_logged("fits no route: nearest is red"));
  one.on(SystemTrigger{.next_start = one.now().run});
  one.next_list({{.vehicle = {1}, .pose = compose(start, {0.0, 0.0, 1.5})}});
  EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty()) << "the operator moves it";
  EXPECT_THAT(one.take<ReadyStatus>(), IsEmpty());
  one.next_list({{.vehicle = {1}, .pose = start}});
  one.next_list({{.vehicle = {1}, .pose = start}});
  EXPECT_EQ(last_status(one), coordination::StepStatus::kPlanned);
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

// --- in the lab ----------------------------------------------------------------------------------

TEST(HlcMachineInTheLab, WaitsForItsFirstListWithoutALimitAndLogsItEveryThirtySeconds) {
  for (const HlcRules& rules : {real_time_in_the_lab(), logical_time_in_the_lab()}) {
    DrivenMachine one(rules);
    one.on(peers());
    one.pass(60 * kSecond);
    one.forget();
    one.pass(600 * kSecond);
    EXPECT_FALSE(one.exit_code());
    const std::vector<machine::LogLine> lines = one.take<machine::LogLine>();
    EXPECT_THAT(lines, SizeIs(20));
    EXPECT_THAT(lines, Each(Field(&machine::LogLine::text,
                                  "waiting: no state list received from the middleware")));
  }
}

TEST(HlcMachineInTheLab, WaitsForTheTriggerWithoutALimitAndLogsItEveryThirtySeconds) {
  DrivenMachine one(real_time_in_the_lab());
  one.on(peers());
  stand(one);
  for (int i = 0; i < 3000; ++i) one.next_list(standing());
  EXPECT_FALSE(one.exit_code());
  std::vector<machine::LogLine> lines = one.take<machine::LogLine>();
  std::erase_if(lines, [](const auto& line) { return !line.text.starts_with("waiting: "); });
  EXPECT_THAT(lines, SizeIs(20));
  EXPECT_THAT(lines, Each(Field(&machine::LogLine::text, "waiting: no start trigger received")));
  one.on(SystemTrigger{.next_start = one.now().run});
  one.next_list(standing());
  EXPECT_EQ(last_status(one), coordination::StepStatus::kPlanned);
}

TEST(HlcMachineInTheLab, AVehicleWithoutOneOfOurControllersIsMissingAndNoReasonToLeave) {
  const std::vector<coordination::MeasuredVehicle> both{seen(1, 0.0, 0.0), seen(2, 0.0, 5.0)};
  for (const HlcRules& rules : {real_time_in_the_lab(), logical_time_in_the_lab()}) {
    DrivenMachine one(rules);
    one.on(peers());
    one.next_list(both);
    one.pass(rules.controller_patience + kSecond);
    for (int i = 0; i < 9; ++i) one.next_list(both);
    EXPECT_TRUE(one.has_logged("absent: high_level_controller_2; their vehicles may be driven"));
    one.on(SystemTrigger{.next_start = one.now().run});
    std::vector<ReportRecord> records;
    for (int i = 0; i < 20; ++i) {
      one.next_list({following(one.machine().controller(), one.step() + 1), both[1]});
      for (ReportRecord& record : one.take<ReportRecord>()) records.push_back(std::move(record));
    }
    EXPECT_FALSE(one.exit_code());
    ASSERT_THAT(records, SizeIs(testing::Ge(20U)));
    EXPECT_THAT(records[10].report.missing, ElementsAre(VehicleId{2}));
    EXPECT_EQ(records.back().report.status, coordination::StepStatus::kPlanned);
  }
}

TEST(HlcMachineInTheLab, AControllerThatHasAppearedIsWaitedForBeyondThePatience) {
  const std::vector<coordination::MeasuredVehicle> both{seen(1, 0.0, 0.0), seen(2, 0.0, 5.0)};
  DrivenMachine one(logical_time_in_the_lab());
  HlcPeers unmatched = peers();
  unmatched.controllers.alive.insert(controller_name(2));
  one.on(unmatched);
  one.next_list(both);
  one.pass(60 * kSecond);
  EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty());
  one.on(peers({2}));
  EXPECT_THAT(one.take<TrajectoryCommand>(), SizeIs(1));
}

/// The lab's vehicles are located half a second after their start.
TEST(HlcMachineReady, InLogicalTimeAPoseThatIsNotTrustedYetIsNotReportedAsOffRoute) {
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/paper_red_alone.yaml"});
  const Pose start = scenario::measured_start(scenario, scenario.vehicles.front());
  const Pose turned = compose(start, {0.0, 0.0, 1.5});
  DrivenMachine one(logical_time(), scenario::make_controller(scenario, {1}));
  one.on(peers());
  for (int i = 0; i < 3; ++i) one.next_list({{.vehicle = {1}, .pose = turned}});
  for (int i = 0; i < 7; ++i) one.next_list({{.vehicle = {1}, .pose = start}});
  EXPECT_FALSE(one.has_logged("fits no route"));
  EXPECT_TRUE(one.has_logged("selects route red"));

  DrivenMachine off_route(logical_time(), scenario::make_controller(scenario, {1}));
  off_route.on(peers());
  for (int i = 0; i < 7; ++i) off_route.next_list({{.vehicle = {1}, .pose = turned}});
  EXPECT_TRUE(off_route.has_logged("fits no route"));
}

/// Of a restarted controller: a middleware in logical time waits for every answer.
TEST(HlcMachineReady, InLogicalTimeAListIsAnsweredWithoutAnEffectOnAVehicleThatRolls) {
  DrivenMachine one(logical_time());
  one.on(peers());
  one.pass(3 * kSecond);
  coordination::MeasuredVehicle rolls = seen(1, 0.0, 0.0);
  rolls.speed_mps = 0.1;
  one.next_list({rolls});
  const std::vector<TrajectoryCommand> answers = one.take<TrajectoryCommand>();
  ASSERT_THAT(answers, SizeIs(1));
  EXPECT_EQ(answers.front().create_stamp, one.step() * kPeriod + kListOffset);
  EXPECT_THAT(answers.front().points, IsEmpty());
  EXPECT_EQ(last_status(one), coordination::StepStatus::kStandby);
  EXPECT_FALSE(one.machine().controller().has_plan());
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

TEST(HlcMachineStart, SendsNothingBeforeTheTriggersTimeAndFromItOnWhatTheVehicleNeedsToStand) {
  for (const HlcRules& rules : {real_time(), real_time_in_the_lab()}) {
    DrivenMachine one(rules);
    one.on(peers());
    stand(one);
    one.on(SystemTrigger{.next_start = one.now().run + 2 * kPeriod});
    one.next_list(standing());
    one.pass(kPeriod / 2);
    EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty());
    one.next_list(standing());
    one.next_list(standing());
    const std::vector<TrajectoryCommand> sent = one.take<TrajectoryCommand>();
    ASSERT_THAT(sent, testing::Not(IsEmpty()));
    const std::vector<TrajectoryPoint>& points = sent.front().points;
    EXPECT_LT(points.front().t, sent.front().valid_after_stamp);
    EXPECT_EQ(points.front().vx_mps, 0.0) << "it drives off a step later";
    EXPECT_GT(points.back().x_m, points.front().x_m);
  }
}

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

TEST(HlcMachineStart, JoinsARunningExperimentOnceItsVehicleStands) {
  DrivenMachine one(real_time());
  std::vector<coordination::MeasuredVehicle> both{seen(1, 0.0, 0.0, 0.5), seen(2, 0.0, 5.0)};
  const auto next_list = [&] {
    one.next_list(both);
    const ConvexPolygon there = footprint_area({1.0, 1.0}, {0.0, 5.0, 0.0});
    one.on(coordination::Traffic{.vehicle = {2},
                                 .step = {one.step()},
                                 .running = {.first = {one.step()}, .final_area_m = there},
                                 .reachable_area_m = there});
  };
  one.on(peers({2}));
  for (int i = 0; i < 20; ++i) next_list();
  EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty()) << "it drives what it was left";
  EXPECT_THAT(one.take<ReportRecord>(), IsEmpty());
  both[0].speed_mps = 0.0;
  for (int i = 0; i < 12; ++i) next_list();
  one.pass(kPeriod / 2);
  const std::vector<ReportRecord> records = one.take<ReportRecord>();
  ASSERT_THAT(records, testing::Not(IsEmpty()));
  EXPECT_EQ(records.front().report.status, coordination::StepStatus::kStandby);
  EXPECT_TRUE(std::ranges::any_of(records, [](const ReportRecord& record) {
    return record.report.status == coordination::StepStatus::kPlanned;
  }));
}

TEST(HlcMachineStart, DoesNotJoinWithoutALabControlThatCouldStopIt) {
  DrivenMachine one(real_time());
  const std::vector<coordination::MeasuredVehicle> both{seen(1, 0.0, 0.0), seen(2, 0.0, 5.0)};
  HlcPeers without_lab_control = peers();
  without_lab_control.stop_request_readers = 0;
  one.on(without_lab_control);
  stand(one, both);
  const auto next_list = [&] {
    one.on(traffic_of(2, one.step() + 1));
    one.next_list(both);
    one.pass(kPeriod / 2);
  };
  for (int i = 0; i < 5; ++i) next_list();
  EXPECT_EQ(last_status(one), coordination::StepStatus::kStandby);
  EXPECT_TRUE(one.has_logged("no lab control could stop this vehicle"));
  one.on(peers());
  for (int i = 0; i < 2; ++i) next_list();
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

TEST(HlcMachineInTheLab, NoticesAControlCentreThatStopsAnsweringWithinThreeSecondsAndAQuarter) {
  DrivenMachine one(real_time_in_the_lab());
  one.on(peers());
  start(one);
  for (int i = 0; i < 25; ++i) {
    one.next_list(standing());
    if (!one.take<ParameterRequest>().empty()) one.on(Parameter{.name = "middleware_period_ms"});
  }
  EXPECT_FALSE(one.has_logged("lab_control lost"));
  one.pass(3 * kSecond + LabControlWatch::kAnswerTime);
  EXPECT_TRUE(one.has_logged("lab_control lost; minimal-risk stop"));
  EXPECT_FALSE(one.exit_code());
  one.pass(kControllerStays + 2 * kMillisecond);
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

TEST(HlcMachineEnd, APlanThatIsLongerThanAMinimalRiskStopIsRefusedByNameValueAndBound) {
  controller::ControllerOptions options{.vehicle = {1}, .horizon_steps = 15};
  auto controller = std::make_unique<controller::Controller>(
      options, controller::east_bound::subgraph(),
      road::ReferencePath({Point(0.0, 0.0), Point(9.0, 0.0)}, false), road::Corridor{});
  try {
    const HlcMachine machine({.rules = real_time()}, std::move(controller));
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("horizon_steps must be <= 14, got 15"));
  }
}

}  // namespace
}  // namespace hlc::high_level_controller::hlc_machine_life_cycle_test
