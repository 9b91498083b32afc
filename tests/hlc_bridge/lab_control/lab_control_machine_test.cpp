#include "hlc_bridge/lab_control/lab_control_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/lab_control/logical_run.hpp"
#include "hlc_bridge/lab_control/real_time_run.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/run_parameters.hpp"

namespace hlc::lab_control::lab_control_machine_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kSecond = kNanosecondsPerSecond;
constexpr Nanoseconds kWall = 5'000 * kSecond;
constexpr Nanoseconds kReal = 1'700'000'000 * kSecond;

template <class Kind>
std::vector<Kind> of(const std::vector<LabControlMachine::Action>& actions) {
  std::vector<Kind> found;
  for (const LabControlMachine::Action& action : actions) {
    if (const auto* kind = std::get_if<Kind>(&action)) found.push_back(*kind);
  }
  return found;
}

std::vector<Nanoseconds> triggers(const std::vector<LabControlMachine::Action>& actions) {
  std::vector<Nanoseconds> times;
  for (const SystemTrigger& trigger : of<SystemTrigger>(actions)) {
    times.push_back(trigger.next_start);
  }
  return times;
}

LabRunSettings settings() { return {.vehicle_ids = {1}, .period = kPeriod, .steps = 3}; }

LabControlPresence all_present() {
  return {.participants = {.alive = {vehicle_name(1), middleware_name(1), controller_name(1)}},
          .trigger_readers = {2, {vehicle_name(1), middleware_name(1)}}};
}

ReportRecord report(std::uint64_t step,
                    coordination::StepStatus status = coordination::StepStatus::kPlanned) {
  ReportRecord record;
  record.report.vehicle = VehicleId{1};
  record.report.step = StepIndex{step};
  record.report.status = status;
  return record;
}

class LogicalLabControl : public testing::Test {
 protected:
  std::vector<LabControlMachine::Action> advance() {
    return lab_.advance({.wall = wall_, .has_begun = false});
  }
  /// The first tick, of the vehicle, is released.
  void begin() {
    lab_.on(all_present());
    lab_.on(ReadyStatus{vehicle_name(1), 0});
    lab_.on(ReadyStatus{middleware_name(1), kListOffset});
    const auto actions = advance();
    ASSERT_THAT(triggers(actions), ElementsAre(0));
    ASSERT_EQ(of<RunState>(actions).size(), 1U);
    EXPECT_EQ(of<RunState>(actions)[0].start, 0U);
  }

  LabControlMachine lab_{std::make_unique<LogicalRun>(settings()), kSecond / 10};
  Nanoseconds wall_{kWall};
};

TEST_F(LogicalLabControl, AnswersWhatItIsAskedFor) {
  for (const char* name : {kPeriodParameter, "no_such_parameter", kActiveIdsParameter}) {
    lab_.on(ParameterRequest{name});
  }
  const auto answers = of<Parameter>(advance());
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0].value, ParameterValue{std::uint64_t{200}});
  EXPECT_EQ(answers[1].value, (ParameterValue{std::vector<std::int32_t>{1}}));
  EXPECT_THAT(of<Parameter>(advance()), IsEmpty());
}

TEST_F(LogicalLabControl, HandsOnEveryReportForTheRecord) {
  lab_.on(report(0, coordination::StepStatus::kStandby));
  lab_.on(report(1, coordination::StepStatus::kStandby));
  const auto records = of<ReportRecord>(advance());
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[1].report.step.value, 1U);
}

TEST_F(LogicalLabControl, AwaitsAsManyEventsAsAreMissingForTheNextTick) {
  EXPECT_EQ(lab_.awaited(), 1U) << "while it gathers anything may count";
  begin();
  EXPECT_EQ(lab_.awaited(), 1U);
  lab_.on(ReadyStatus{vehicle_name(1), kVehiclePeriod});
  EXPECT_THAT(triggers(advance()), ElementsAre(kListOffset));
  EXPECT_EQ(lab_.wake_up().run, std::nullopt);
  EXPECT_EQ(lab_.wake_up().wall, wall_ + kSecond)
      << "progress; then a process with a pending reply is dead";
}

TEST_F(LogicalLabControl, LogsOnceThatAVehicleIsStuck) {
  begin();
  ReportRecord waiting = report(200);
  waiting.report.waiting = {.vehicles = {{2}}, .since = {102}};
  lab_.on(waiting);
  EXPECT_THAT(of<machine::LogLine>(advance()), IsEmpty());
  waiting.report.step.value = 201;
  lab_.on(waiting);
  EXPECT_THAT(of<machine::LogLine>(advance()),
              ElementsAre(machine::warning("stuck: vehicle 1, waiting for 2 for 20.0 s, although "
                                           "its road would be free without the others; it has not "
                                           "moved since its controller began: if that was at the "
                                           "start of the run, place the vehicles elsewhere")));
  waiting.report.step.value = 202;
  lab_.on(waiting);
  EXPECT_THAT(of<machine::LogLine>(advance()), IsEmpty());
}

TEST_F(LogicalLabControl, LogsOnceThatAVehicleHasArrived) {
  begin();
  lab_.on(report(200));
  static_cast<void>(advance());
  ReportRecord arrived = report(201);
  arrived.report.arrived_since = StepIndex{201};
  lab_.on(arrived);
  const std::vector<machine::LogLine> lines = of<machine::LogLine>(advance());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].severity, machine::Severity::kInfo);
  EXPECT_EQ(lines[0].text, "vehicle 1 arrived at its goal after 0.2 s");
  arrived.report.step.value = 202;
  lab_.on(arrived);
  EXPECT_THAT(of<machine::LogLine>(advance()), IsEmpty());
}

TEST_F(LogicalLabControl, WhoOwesAnAnswerForTooLongIsDead) {
  begin();
  wall_ += kAnswerTimeout;
  const auto actions = advance();
  EXPECT_THAT(of<machine::LogLine>(actions),
              ElementsAre(machine::error("vehicle_raspberry_1 died: answer overdue")));
  ASSERT_EQ(of<Log>(actions).size(), 1U);
  EXPECT_EQ(of<Log>(actions)[0].level, 1);
  ASSERT_EQ(of<RunState>(actions).size(), 1U);
  EXPECT_EQ(of<RunState>(actions)[0].phase, RunPhase::kMinimalRiskStop);
}

TEST_F(LogicalLabControl, ShowsHowFarTheRunIs) {
  EXPECT_THAT(of<ProgressText>(advance()), IsEmpty());
  EXPECT_EQ(lab_.wake_up().wall, kWall + kSecond);
  wall_ += kSecond;
  auto shown = of<ProgressText>(advance());
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_EQ(shown[0].text,
            "waiting: missing: vehicle_raspberry_1, middleware_1, high_level_controller_1");
  begin();
  wall_ += 2 * kSecond;
  shown = of<ProgressText>(advance());
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_EQ(shown[0].text, "step 0 of 3, 0.0 s driven in 2.0 s");
}

TEST_F(LogicalLabControl, LeavesWhenNobodyReadsTriggersAnyMore) {
  lab_.on(all_present());
  lab_.on(machine::StopSignal{});
  EXPECT_THAT(triggers(advance()), ElementsAre(kStopSymbol));
  EXPECT_TRUE(lab_.run().finished());
  EXPECT_EQ(lab_.exit_code(), std::nullopt);
  EXPECT_EQ(lab_.awaited(), machine::kOnlyUrgent);
  lab_.on(report(7));
  lab_.on(LabControlPresence{});
  EXPECT_EQ(of<ReportRecord>(advance()).size(), 1U) << "one that came with the stop";
  EXPECT_EQ(lab_.exit_code(), kExitInterrupted);
}

TEST_F(LogicalLabControl, DoesNotWaitForLongForThoseWhoStay) {
  lab_.on(all_present());
  static_cast<void>(advance());
  wall_ += settings().startup_timeout;
  static_cast<void>(advance());
  EXPECT_EQ(lab_.wake_up().wall, wall_ + LabControlMachine::kLeaveTime);
  wall_ = *lab_.wake_up().wall;
  static_cast<void>(advance());
  EXPECT_EQ(lab_.exit_code(), kExitMissing);
}

TEST(RealTimeLabControl, CountsByTheTimeOfTheRun) {
  LabControlMachine lab{std::make_unique<RealTimeRun>(settings()), kSecond / 10};
  lab.on(all_present());
  lab.on(ReadyStatus{middleware_ready_id(1), 0});
  for (Nanoseconds t = kReal - kSecond; t <= kReal; t += kVehiclePeriod) {
    lab.on(VehicleState{.vehicle_id = 1, .create_stamp = t});
  }
  const auto actions = lab.advance({.run = kReal, .wall = kWall});
  EXPECT_THAT(triggers(actions), ElementsAre(kReal + RealTimeRun::kStartDelay));
  ASSERT_EQ(of<RunState>(actions).size(), 1U);
  EXPECT_EQ(of<RunState>(actions)[0].start, kReal + RealTimeRun::kStartDelay)
      << "for controllers that come later";
  EXPECT_EQ(lab.awaited(), 1U);
  EXPECT_EQ(lab.wake_up().run, kReal + RealTimeRun::kStartDelay + RealTimeRun::kReportTimeout);
  EXPECT_EQ(lab.wake_up().wall, kWall + kSecond);
}

TEST(RealTimeLabControl, SaysWhoIsBack) {
  LabRunSettings continues = settings();
  continues.on_death = OnDeath::kContinue;
  LabControlMachine lab{std::make_unique<RealTimeRun>(continues), kSecond / 10};
  lab.on(all_present());
  lab.on(ReadyStatus{middleware_ready_id(1), 0});
  for (Nanoseconds t = kReal - kSecond; t <= kReal; t += kVehiclePeriod) {
    lab.on(VehicleState{.vehicle_id = 1, .create_stamp = t});
  }
  static_cast<void>(lab.advance({.run = kReal, .wall = kWall}));
  LabControlPresence without = all_present();
  without.participants.alive.erase(middleware_name(1));
  without.participants.lost.insert(middleware_name(1));
  lab.on(without);
  EXPECT_EQ(of<Log>(lab.advance({.run = kReal + 1, .wall = kWall + 1})).size(), 1U);
  lab.on(all_present());
  EXPECT_THAT(of<machine::LogLine>(lab.advance({.run = kReal + 2, .wall = kWall + 2})),
              ElementsAre(machine::info("middleware_1 is back")));
}

}  // namespace
}  // namespace hlc::lab_control::lab_control_machine_test
