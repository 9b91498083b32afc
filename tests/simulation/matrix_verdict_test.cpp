// That a verdict fails: an undisturbed run is taken for one with a fault, and changed by hand.
#include "vehicle_sim/closed_loop/matrix_verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::closed_loop::matrix_verdict_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Nanoseconds kSecond = kNanosecondsPerSecond;
constexpr Nanoseconds kFault = 8 * kSecond;
constexpr Nanoseconds kStop = 18 * kSecond;

coordination::Report planned(std::uint8_t vehicle, std::uint64_t step) {
  return {.vehicle = {vehicle}, .step = {step}, .status = coordination::StepStatus::kPlanned};
}

/// Two cars that drive at 1 m/s, and report.
MatrixRun undisturbed() {
  MatrixRun run;
  run.diary.begin_of_drive = 3 * kSecond;
  run.diary.stop = kStop;
  run.diary.lives[kLabControlName] = {.end = kStop, .exit_code = kExitInterrupted};
  for (const std::uint8_t car : std::vector<std::uint8_t>{1, 2}) {
    for (const std::string& name :
         {controller_name(car), middleware_name(car), vehicle_name(car)}) {
      run.diary.lives[name] = {.end = kStop, .exit_code = kExitGood};
    }
    for (Nanoseconds t = 0; t < kStop; t += kSecond / 5) {
      run.diary.drives[car].push_back({.at = t, .time = t, .speed_mps = 1.0});
      if (t < 3 * kSecond) continue;
      run.diary.steps.push_back({.at = t, .report = planned(car, t / (kSecond / 5))});
    }
  }
  return run;
}

MatrixRun with_fault_of(const std::string& process) {
  MatrixRun run = undisturbed();
  run.culprit = process;
  run.faults = {{.kind = FaultKind::kFreeze, .begin = kFault, .process = process}};
  return run;
}

MatrixCell cell(Role role, MatrixFault fault) {
  return {.role = role, .fault = fault, .phase = MatrixPhase::kRun};
}

std::vector<std::string> failed_checks(const MatrixCell& cell, const MatrixRun& run) {
  std::vector<std::string> checks;
  for (const Violation& problem : verdict_of(cell, run, undisturbed()).problems) {
    checks.push_back(problem.check);
  }
  return checks;
}

void log(MatrixRun& run, const std::string& process, const std::string& text) {
  run.diary.lines.push_back(
      {.at = kFault + kSecond, .process = process, .line = machine::error(text)});
}

void stand(MatrixRun& run, std::uint8_t car, Nanoseconds from) {
  for (RunDiary::Tick& tick : run.diary.drives[car]) {
    if (tick.at >= from) tick.speed_mps = 0.0;
  }
}

const MatrixCell kFrozen = cell(Role::kController, MatrixFault::kFreeze);
const MatrixCell kKilled = cell(Role::kController, MatrixFault::kKill);

MatrixRun killed_controller() {
  MatrixRun run = with_fault_of(controller_name(2));
  run.diary.lives[controller_name(2)] = {};
  stand(run, 2, kFault + 2 * kSecond);
  log(run, kLabControlName, controller_name(2) + " died: participant left or lease expired");
  return run;
}

TEST(MatrixVerdict, WithoutAnEffectNobodyNeedsToNameTheProcess) {
  const MatrixRun run = with_fault_of(controller_name(2));
  EXPECT_THAT(failed_checks(kFrozen, run), IsEmpty());
  EXPECT_EQ(verdict_of(kFrozen, run, undisturbed()).naming, Naming::kNoEffect);
}

TEST(MatrixVerdict, ACarThatStandsIsAnEffectOfWhichTheProcessMustBeNamed) {
  MatrixRun run = with_fault_of(controller_name(2));
  stand(run, 2, kFault + kSecond);
  EXPECT_THAT(failed_checks(kFrozen, run), ElementsAre("culprit"));
  log(run, kLabControlName, controller_name(1) + " is slow");
  log(run, kLabControlName, controller_name(2) + "0 is slow");
  log(run, controller_name(2), controller_name(2) + " is slow");
  EXPECT_THAT(failed_checks(kFrozen, run), ElementsAre("culprit")) << "another, or itself";
  log(run, kLabControlName, controller_name(2) + " is slow");
  EXPECT_THAT(failed_checks(kFrozen, run), IsEmpty());
}

TEST(MatrixVerdict, AReportOfAnotherVehicleNamesTheProcess) {
  MatrixRun run = with_fault_of(controller_name(2));
  for (RunDiary::Step& step : run.diary.steps) {
    if (step.at < kFault || step.report.vehicle.value != 1) continue;
    step.report.status = coordination::StepStatus::kFallback;
    step.report.reason = coordination::FallbackReason::kMissing;
  }
  EXPECT_THAT(failed_checks(kFrozen, run), ElementsAre("culprit"));
  run.diary.steps.back().report = planned(1, 0);
  run.diary.steps.back().report.missing = {{2}};
  EXPECT_THAT(failed_checks(kFrozen, run), IsEmpty());
  EXPECT_EQ(verdict_of(kFrozen, run, undisturbed()).naming, Naming::kReport);
}

TEST(MatrixVerdict, ExitCodesOfOthersStayThoseOfTheUndisturbedRun) {
  MatrixRun run = killed_controller();
  EXPECT_THAT(failed_checks(kKilled, run), IsEmpty());
  run.diary.lives[middleware_name(1)].exit_code = kExitDied;
  EXPECT_THAT(failed_checks(kKilled, run), ElementsAre("exit codes"));
}

TEST(MatrixVerdict, OnlyAProcessThatIsKilledForGoodMayBeLeft) {
  MatrixRun run = killed_controller();
  run.diary.lives[vehicle_name(1)] = {};
  EXPECT_THAT(failed_checks(kKilled, run), ElementsAre("leftovers"));
}

TEST(MatrixVerdict, TheLabControlBlamesNoProcessThatRuns) {
  MatrixRun run = killed_controller();
  log(run, kLabControlName, controller_name(1) + " died: report overdue");
  EXPECT_THAT(failed_checks(kKilled, run), ElementsAre("blame"));
  run.diary.lives[controller_name(1)].end = kFault;
  EXPECT_THAT(failed_checks(kKilled, run), IsEmpty()) << "it has left";
}

TEST(MatrixVerdict, ACarStandsInTime) {
  MatrixRun run = with_fault_of(controller_name(2));
  run.diary.lives[controller_name(2)] = {};
  stand(run, 2, kFault + 3 * kSecond);
  log(run, kLabControlName, controller_name(2) + " died: participant left or lease expired");
  EXPECT_THAT(failed_checks(kKilled, run), ElementsAre("standstill"));
  const auto standstill_s = verdict_of(kKilled, run, undisturbed()).standstill_s;
  ASSERT_TRUE(standstill_s);
  EXPECT_DOUBLE_EQ(*standstill_s, 3.0);
}

TEST(MatrixVerdict, ViolationsOfTheRunAreThoseOfTheCell) {
  MatrixRun run = with_fault_of(controller_name(2));
  run.result.violations.push_back({.check = "footprints"});
  EXPECT_THAT(failed_checks(kFrozen, run), ElementsAre("footprints"));
}

}  // namespace
}  // namespace hlc::closed_loop::matrix_verdict_test
