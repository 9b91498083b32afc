// What the machine of a controller does when others are lost, come back, or are silent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/hlc_bridge/hlc/driven_machine.hpp"
#include "tests/support/folders.hpp"

namespace hlc::high_level_controller::hlc_machine_loss_test {
namespace {

using namespace driven_machine;
using testing::IsEmpty;
using testing::SizeIs;

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

// A forged demand stopped all vehicles for good with exit code 0 and without a line.
TEST(HlcMachineLoss, LogsADemandedMinimalRiskStopOnceAndFailsWithTheRun) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  one.forget();
  one.on(RunState{.phase = RunPhase::kMinimalRiskStop});
  EXPECT_TRUE(one.has_logged("lab_control demands a minimal-risk stop"));
  one.forget();
  one.on(RunState{.phase = RunPhase::kMinimalRiskStop});
  EXPECT_FALSE(one.has_logged("lab_control demands a minimal-risk stop"));
  one.on(SystemTrigger{.next_start = kStopSymbol});
  EXPECT_EQ(one.exit_code(), kExitDied);
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
  const auto lose_the_labs_own = [&] {
    one.on(alone);
    one.pass(machine::LabControlWatch::kGap);
    one.next_list(standing());
    EXPECT_EQ(last_status(one), coordination::StepStatus::kMinimalRiskStop);
  };
  lose_the_labs_own();
  one.on(peers());
  one.next_list(standing());
  EXPECT_NE(last_status(one), coordination::StepStatus::kMinimalRiskStop);

  lose_the_labs_own();
  one.pass(kControllerStays);
  EXPECT_EQ(one.exit_code(), kExitDied);
}

// It left at once, as if the lab had ended, though it was itself that had not run for a while.
TEST(HlcMachineLoss, OutlivesAMomentInWhichAllOthersAreGone) {
  DrivenMachine one(real_time());
  one.on(peers());
  start(one);
  HlcPeers nobody = without_middleware();
  nobody.lab = {.alive = {}, .lost = {kLabControlName}};
  nobody.controllers = nobody.lab;
  nobody.stop_request_readers = 0;
  one.on(nobody);
  EXPECT_TRUE(one.has_logged("lab_control lost"));
  EXPECT_TRUE(one.has_logged("middleware_1 lost; no commands reach the vehicle"));
  one.pass(kSecond / 2);
  EXPECT_FALSE(one.exit_code());
  one.on(peers());
  one.next_list(standing());
  EXPECT_EQ(last_status(one), coordination::StepStatus::kPlanned);
}

TEST(HlcMachineLoss, AMiddlewareThatIsStartedAgainBeforeTheStartIsAnsweredAgain) {
  DrivenMachine one(real_time());
  one.on(peers());
  stand(one);
  one.on(without_middleware());
  one.pass(kSecond);
  one.forget();
  one.on(peers());
  one.next_list(standing());
  one.pass(kSecond / 2);
  EXPECT_THAT(one.take<ReportRecord>(), testing::Not(IsEmpty()));
  EXPECT_THAT(one.take<ReadyStatus>(), testing::Not(IsEmpty()));
  EXPECT_FALSE(one.exit_code());
}

// A car that had been moved away by hand was sent its old standstill, as the newest and valid
// command.
TEST(HlcMachineLoss, ACarThatIsElsewhereHearsNothingUntilItStandsAndIsPlannedFromThere) {
  for (const HlcRules& rules : {real_time(), real_time_in_the_lab(), logical_time()}) {
    DrivenMachine one(rules);
    one.on(peers());
    start(one);
    one.next_list(standing());
    one.pass(kPeriod / 2);
    one.forget();
    std::size_t num_logged = 0;
    for (int i = 0; i < 20; ++i) {
      one.next_list({controller::east_bound::seen(1, 2.0 + 0.01 * i, 1.3, 0.05)});
      one.pass(kPeriod / 2);
      for (const TrajectoryCommand& command : one.take<TrajectoryCommand>()) {
        EXPECT_EQ(rules.start, StartRule::kTogether) << "nothing is sent";
        EXPECT_THAT(command.points, IsEmpty()) << "the list is answered";
      }
      for (const machine::LogLine& line : one.take<machine::LogLine>()) {
        num_logged += line.text.find(
                          "vehicle 1 is elsewhere: at (2.00, 1.30), its plan at (0.00, "
                          "0.00)") != std::string::npos
                          ? 1U
                          : 0U;
      }
      EXPECT_EQ(num_logged, 1U);
    }
    one.next_list({controller::east_bound::seen(1, 2.2, 1.3)});
    const std::vector<TrajectoryCommand> commands = one.take<TrajectoryCommand>();
    ASSERT_THAT(commands, testing::Not(IsEmpty()));
    ASSERT_THAT(commands.front().points, testing::Not(IsEmpty()));
    EXPECT_NEAR(commands.front().points.front().x_m, 2.2, 1e-6);
    EXPECT_NEAR(commands.front().points.front().y_m, 1.3, 1e-6);
  }
}

TEST(HlcMachineLoss, ACarThatHasNoWayOntoItsRouteIsLeftToTheOperatorUntilItHas) {
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_three_cars.yaml"});
  const Pose start_pose = scenario::measured_start(scenario, scenario.vehicles.front());
  const auto standing_at = [](const Pose& pose) {
    return std::vector{coordination::MeasuredVehicle{.vehicle = {1}, .pose = pose}};
  };
  DrivenMachine one(real_time_in_the_lab(), scenario::make_controller(scenario, {1}));
  one.on(peers());
  start(one, standing_at(start_pose));
  one.next_list(standing_at(start_pose));
  Pose off = start_pose;
  off.x_m = 2.25;
  off.y_m = 3.0;
  for (int i = 0; i < 20; ++i) {
    one.pass(kPeriod / 2);
    one.forget();
    one.next_list(standing_at(off));
  }
  EXPECT_EQ(one.take<ReportRecord>().back().report.reason, coordination::FallbackReason::kOffRoute);
  EXPECT_THAT(one.take<TrajectoryCommand>(), IsEmpty());
  for (int i = 0; i < 2; ++i) one.next_list(standing_at(start_pose));
  EXPECT_THAT(one.take<TrajectoryCommand>(), testing::Not(IsEmpty()));
}

// In the lab the local domain holds all controllers of a computer.
TEST(HlcMachineLoss, IsNotDisturbedWhenAnotherControllerOfItsMachineLeaves) {
  DrivenMachine one(real_time());
  HlcPeers among_others = peers();
  among_others.local.alive = {middleware_name(1), controller_name(2)};
  one.on(among_others);
  start(one);
  among_others.local = {.alive = {middleware_name(1)}, .lost = {controller_name(2)}};
  one.on(among_others);
  for (int i = 0; i < 200; ++i) one.next_list(standing());
  EXPECT_FALSE(one.exit_code());
  EXPECT_FALSE(one.has_logged("lost"));
  EXPECT_THAT(one.take<ReportRecord>(), SizeIs(200));
}

TEST(HlcMachineLoss, SaysWhoseListsDoNotComeThoughItIsThere) {
  DrivenMachine one(real_time());
  one.on(peers());
  stand(one);
  one.pass(30 * kSecond);
  EXPECT_TRUE(one.has_logged("waiting: no state list from middleware_1 for"));
  EXPECT_FALSE(one.exit_code());
}

TEST(HlcMachineLoss, StaysAndLogsItOnceWhileNoOtherControllerIsReceived) {
  const std::vector<coordination::MeasuredVehicle> both{
      controller::east_bound::seen(1, 0.0, 0.0), controller::east_bound::seen(2, 0.0, 2.0, 0.5)};
  DrivenMachine one(real_time());
  one.on(peers({2}));
  start(one, both);
  one.next_list(both);
  const ConvexPolygon near = footprint_area({1.0, 1.0}, {});
  one.on(coordination::Traffic{.vehicle = {2},
                               .step = {one.step()},
                               .running = {.first = {one.step()}, .final_area_m = near},
                               .reachable_area_m = near,
                               .silent = {{1}}});  // else car 1 would drive off
  one.pass(kPeriod / 2);
  one.forget();
  for (std::uint64_t i = 1; i < coordination::kSilentSteps; ++i) one.next_list(both);
  one.pass(kPeriod / 2);
  EXPECT_FALSE(one.has_logged("stays until"));
  one.next_list(both);
  one.pass(kPeriod / 2);
  EXPECT_TRUE(one.has_logged("vehicle stays until another controller is received"));
  EXPECT_EQ(last_status(one), coordination::StepStatus::kFallback);
  one.forget();
  one.next_list(both);
  one.pass(kPeriod / 2);
  EXPECT_FALSE(one.has_logged("stays until"));
}

// A middleware that had died at the stop was not named: only the lab control, which had left in
// order.
TEST(HlcMachineInLogicalTime, NamesTheMiddlewareThatForwardsNoStopWhenTheLabControlHasLeft) {
  DrivenMachine one(logical_time());
  one.on(peers());
  start(one);
  HlcPeers without_lab_control = peers();
  without_lab_control.lab = {.alive = {}, .lost = {kLabControlName}};
  without_lab_control.stop_request_readers = 0;
  one.on(without_lab_control);
  one.pass(2 * kSecond);
  EXPECT_TRUE(one.has_logged("lab_control lost"));
  EXPECT_TRUE(one.has_logged("no stop came through middleware_1"));
}

}  // namespace
}  // namespace hlc::high_level_controller::hlc_machine_loss_test
