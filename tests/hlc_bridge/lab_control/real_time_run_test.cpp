#include "hlc_bridge/lab_control/real_time_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/messages/node_names.hpp"
#include "tests/hlc_bridge/lab_control/timer_names.hpp"

namespace hlc::lab_control::real_time_run_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kSecond = kNanosecondsPerSecond;
constexpr Nanoseconds kStart = 1'700'000'000 * kSecond;

LabRunSettings settings() { return {.vehicle_ids = {1, 2}, .period = kPeriod, .steps = 20}; }

const std::set<std::string> kAll{vehicle_name(1),    vehicle_name(2),    middleware_name(1),
                                 middleware_name(2), controller_name(1), controller_name(2)};

/// A second of standing states, as a vehicle sends them before the start.
std::vector<VehicleState> second_of_states(std::uint8_t id) {
  std::vector<VehicleState> states;
  for (Nanoseconds t = kStart - kSecond; t <= kStart; t += kVehiclePeriod) {
    states.push_back({.vehicle_id = id, .create_stamp = t});
  }
  return states;
}

ReportRecord report(std::uint8_t id, std::uint64_t step, coordination::StepStatus status) {
  ReportRecord record;
  record.report.vehicle = VehicleId{id};
  record.report.step = StepIndex{step};
  record.report.status = status;
  return record;
}

class RealTimeRunTest : public testing::Test {
 protected:
  void make_ready() {
    run_.presence(kAll, {});
    run_.trigger_readers(timers_of({1, 2}));
    for (const std::uint8_t id : settings().vehicle_ids) {
      send_settled_states(id);
      run_.ready({middleware_ready_id(id), 0});
    }
  }
  void send_settled_states(std::uint8_t id) {
    for (const VehicleState& state : second_of_states(id)) run_.state(state);
  }
  /// Every controller reports the step of `now`; then the run is advanced.
  LabRunActions advance_with_reports(Nanoseconds now, coordination::StepStatus first,
                                     coordination::StepStatus second) {
    run_.report(report(1, step_at(now, kPeriod), first));
    run_.report(report(2, step_at(now, kPeriod), second));
    return run_.advance(now);
  }

  RealTimeRun run_{settings()};
};

TEST_F(RealTimeRunTest, TriggersOneSecondAheadWhenEverybodyIsReady) {
  make_ready();
  const LabRunActions actions = run_.advance(kStart);
  EXPECT_THAT(actions.triggers, ElementsAre(kStart + kSecond));
  EXPECT_EQ(actions.run_state, RunPhase::kRunning);
  EXPECT_THAT(run_.advance(kStart + 1).triggers, IsEmpty());
}

TEST_F(RealTimeRunTest, WaitsForEachSingleOne) {
  run_.trigger_readers(timers_of({1, 2}));
  send_settled_states(1);
  run_.ready({middleware_ready_id(1), 0});
  send_settled_states(2);
  EXPECT_THAT(run_.advance(kStart).triggers, IsEmpty());
  run_.ready({middleware_ready_id(2), 0});
  std::set<std::string> readers = timers_of({1});
  readers.insert({vehicle_name(2), "recorder"});
  run_.trigger_readers(readers);
  EXPECT_THAT(run_.advance(kStart + 1).triggers, IsEmpty());
  run_.trigger_readers(timers_of({1, 2}));
  EXPECT_THAT(run_.advance(kStart + 2).triggers, ElementsAre(kStart + 2 + kSecond));
}

TEST_F(RealTimeRunTest, AMiddlewareOfSeveralVehiclesIsReadyForAll) {
  run_.trigger_readers(timers_of({1, 2}));
  send_settled_states(1);
  send_settled_states(2);
  run_.ready({middleware_ready_id(std::vector<std::uint8_t>{1, 2}), 0});
  EXPECT_THAT(run_.advance(kStart).triggers, ElementsAre(kStart + kSecond));
}

TEST_F(RealTimeRunTest, AVehicleIsReadyWhenItsStatesHaveSettled) {
  run_.presence(kAll, {});
  run_.trigger_readers(timers_of({1, 2}));
  run_.ready({middleware_ready_id(1), 0});
  run_.ready({middleware_ready_id(2), 0});
  send_settled_states(1);
  std::vector<VehicleState> states = second_of_states(2);
  states[25].pose.x_m = 1.0;  // it finds itself
  for (const VehicleState& state : states) run_.state(state);
  EXPECT_THAT(run_.advance(kStart).triggers, IsEmpty());
  EXPECT_EQ(run_.waiting_for(), "not ready: vehicle_raspberry_2");
}

TEST_F(RealTimeRunTest, TimerNamesAreNoSignOfReadinessInRealTime) {
  run_.trigger_readers(timers_of({1, 2}));
  for (const std::uint8_t id : settings().vehicle_ids) {
    send_settled_states(id);
    run_.ready({middleware_name(id), 0});
  }
  EXPECT_THAT(run_.advance(kStart).triggers, IsEmpty());
}

TEST_F(RealTimeRunTest, AClockThatIsSetBackIsNoTimeThatHasPassed) {
  (void)run_.advance(kStart);
  EXPECT_THAT(run_.advance(kStart - 10 * kSecond).triggers, IsEmpty());
  EXPECT_FALSE(run_.finished()) << run_.result().reason;
  make_ready();
  EXPECT_THAT(run_.advance(kStart - 9 * kSecond).triggers, ElementsAre(kStart + kSecond));
}

TEST_F(RealTimeRunTest, StopsOnePeriodAfterTheLastStepAndFinishesAfterBraking) {
  make_ready();
  (void)run_.advance(kStart);
  const std::uint64_t k0 = step_at(kStart + kSecond, kPeriod);
  (void)advance_with_reports(kStart + kSecond - 1, coordination::StepStatus::kStandby,
                             coordination::StepStatus::kStandby);
  const std::uint64_t after_last = k0 + settings().steps + 1;
  for (std::uint64_t step = k0; step < after_last; ++step) {
    (void)advance_with_reports(step * kPeriod, coordination::StepStatus::kPlanned,
                               coordination::StepStatus::kFallback);
  }
  const Nanoseconds end = after_last * kPeriod;
  EXPECT_EQ(run_.wake_up(), end);
  EXPECT_THAT(run_.advance(end - 1).triggers, IsEmpty());
  EXPECT_THAT(run_.advance(end).triggers, ElementsAre(kStopSymbol));
  EXPECT_EQ(run_.wake_up(), end + kBrakingTime);
  EXPECT_FALSE(run_.finished());
  (void)run_.advance(end + kBrakingTime);
  EXPECT_TRUE(run_.finished());
  EXPECT_EQ(run_.result().exit_code, kExitGood);
  EXPECT_EQ(run_.result().first_step, k0);
}

class OnDeathContinue : public RealTimeRunTest {
 protected:
  OnDeathContinue() {
    run_.presence(kAll, {});
    run_.trigger_readers(timers_of({1, 2}));
  }
  /// Advances period by period; controller 2 reports only if `is_alive`.
  LabRunActions drive(std::uint64_t from, std::uint64_t to, bool is_alive) {
    LabRunActions all;
    for (std::uint64_t step = from; step < to; ++step) {
      run_.report(report(1, step, coordination::StepStatus::kPlanned));
      if (is_alive) run_.report(report(2, step, coordination::StepStatus::kPlanned));
      const LabRunActions actions = run_.advance(step * kPeriod);
      std::ranges::copy(actions.deaths, std::back_inserter(all.deaths));
      std::ranges::copy(actions.returns, std::back_inserter(all.returns));
      std::ranges::copy(actions.triggers, std::back_inserter(all.triggers));
      if (actions.run_state) all.run_state = actions.run_state;
    }
    return all;
  }
  void begin() {
    for (const std::uint8_t id : settings().vehicle_ids) {
      for (const VehicleState& state : second_of_states(id)) run_.state(state);
      run_.ready({middleware_ready_id(id), 0});
    }
    EXPECT_EQ(run_.advance(kStart).triggers.size(), 1U);
  }
  void lose_controller_2() {
    std::set<std::string> others = kAll;
    others.erase(controller_name(2));
    run_.presence(others, {controller_name(2)});
  }

  static LabRunSettings long_run() {
    LabRunSettings settings = real_time_run_test::settings();
    settings.steps = 40;
    settings.on_death = OnDeath::kContinue;
    return settings;
  }
  RealTimeRun run_{long_run()};
  std::uint64_t k0_{step_at(kStart + kSecond, kPeriod)};
};

TEST_F(OnDeathContinue, TheRunGoesOnAndEndsWellIfWhoDiedIsBack) {
  begin();
  (void)drive(k0_, k0_ + 10, true);
  lose_controller_2();
  const LabRunActions death = drive(k0_ + 10, k0_ + 25, false);
  ASSERT_EQ(death.deaths.size(), 1U);
  EXPECT_EQ(death.deaths.front().process, controller_name(2));
  EXPECT_EQ(death.run_state, std::nullopt) << "no minimal-risk stop";
  EXPECT_THAT(death.triggers, IsEmpty());
  run_.presence(kAll, {});
  EXPECT_THAT(drive(k0_ + 25, k0_ + 26, false).returns, IsEmpty()) << "it does not report yet";
  EXPECT_THAT(drive(k0_ + 26, k0_ + 41, true).returns, ElementsAre(controller_name(2)));
  EXPECT_THAT(drive(k0_ + 41, k0_ + 42, true).triggers, ElementsAre(kStopSymbol));
  EXPECT_EQ(run_.result().exit_code, kExitGood);
  EXPECT_EQ(run_.result().deaths.size(), 1U) << "it is recorded nevertheless";
}

TEST_F(OnDeathContinue, TheRunHasFailedIfWhoDiedIsNotBackAtItsEnd) {
  begin();
  (void)drive(k0_, k0_ + 10, true);
  lose_controller_2();
  EXPECT_THAT(drive(k0_ + 10, k0_ + 42, false).triggers, ElementsAre(kStopSymbol));
  EXPECT_EQ(run_.result().exit_code, kExitDied);
  EXPECT_THAT(run_.result().reason, HasSubstr(controller_name(2)));
}

TEST_F(OnDeathContinue, WhoIsBackAndDiesAgainIsNamedAgain) {
  begin();
  (void)drive(k0_, k0_ + 10, true);
  lose_controller_2();
  (void)drive(k0_ + 10, k0_ + 12, false);
  run_.presence(kAll, {});
  (void)drive(k0_ + 12, k0_ + 14, true);
  EXPECT_EQ(drive(k0_ + 14, k0_ + 30, false).deaths.size(), 1U) << "it does not report";
}

class OnDeathContinueWithStandby : public OnDeathContinue {
 protected:
  /// Both report in every step, controller 2 that it is on standby.
  LabRunActions drive_alone(std::uint64_t from, std::uint64_t to) {
    LabRunActions all;
    for (std::uint64_t step = from; step < to; ++step) {
      run_.report(report(1, step, coordination::StepStatus::kPlanned));
      run_.report(report(2, step, coordination::StepStatus::kStandby));
      const LabRunActions actions = run_.advance(step * kPeriod);
      std::ranges::copy(actions.deaths, std::back_inserter(all.deaths));
      std::ranges::copy(actions.returns, std::back_inserter(all.returns));
    }
    return all;
  }
};

// It was named dead and back in every step.
TEST_F(OnDeathContinueWithStandby, AControllerOnStandbyIsNamedOnceAndBackWhenItDrives) {
  begin();
  const LabRunActions standby = drive_alone(k0_, k0_ + 30);
  ASSERT_EQ(standby.deaths.size(), 1U);
  EXPECT_EQ(standby.deaths.front().process, controller_name(2));
  EXPECT_THAT(standby.returns, IsEmpty());
  EXPECT_THAT(drive(k0_ + 30, k0_ + 32, true).returns, ElementsAre(controller_name(2)));
}

// The controller was named dead, too.
TEST_F(OnDeathContinueWithStandby, AControllerWhoseVehicleIsDeadIsNotNamed) {
  begin();
  std::set<std::string> others = kAll;
  others.erase(vehicle_name(2));
  run_.presence(others, {vehicle_name(2)});
  const LabRunActions actions = drive_alone(k0_, k0_ + 30);
  ASSERT_EQ(actions.deaths.size(), 1U);
  EXPECT_EQ(actions.deaths.front().process, vehicle_name(2));
  run_.presence(kAll, {});
  const LabRunActions back = drive_alone(k0_ + 30, k0_ + 35);
  EXPECT_THAT(back.returns, ElementsAre(vehicle_name(2)));
  EXPECT_THAT(back.deaths, IsEmpty()) << "it has not had the time to drive";
}

TEST_F(RealTimeRunTest, LostProcessIsNamedAndTheOthersDriveOut) {
  make_ready();
  (void)run_.advance(kStart);
  std::set<std::string> others = kAll;
  others.erase(middleware_name(2));
  run_.presence(others, {middleware_name(2)});
  const LabRunActions actions = run_.advance(kStart + 2 * kSecond);
  ASSERT_EQ(actions.deaths.size(), 1U);
  EXPECT_EQ(actions.deaths.front().process, middleware_name(2));
  EXPECT_EQ(actions.run_state, RunPhase::kMinimalRiskStop);
  EXPECT_THAT(actions.triggers, IsEmpty());
  for (Nanoseconds t = kStart + 2 * kSecond; t < kStart + 5 * kSecond; t += kPeriod) {
    run_.report(report(1, step_at(t, kPeriod), coordination::StepStatus::kPlanned));
    EXPECT_THAT(run_.advance(t).deaths, IsEmpty());
  }
  EXPECT_EQ(run_.wake_up(), kStart + 5 * kSecond);
  EXPECT_THAT(run_.advance(kStart + 5 * kSecond).triggers, ElementsAre(kStopSymbol));
  // All leave on the stop: no further death.
  run_.presence({}, kAll);
  EXPECT_THAT(run_.advance(kStart + 5 * kSecond + 1).deaths, IsEmpty());
  (void)run_.advance(kStart + 5 * kSecond + kBrakingTime);
  EXPECT_TRUE(run_.finished());
  EXPECT_EQ(run_.result().exit_code, kExitDied);
  EXPECT_EQ(run_.result().deaths.size(), 1U);
}

TEST_F(RealTimeRunTest, NamesWhoIsMissing) {
  run_.presence({vehicle_name(1), vehicle_name(2), middleware_name(1), controller_name(1),
                 controller_name(2)},
                {});
  send_settled_states(1);
  run_.ready({middleware_ready_id(1), 0});
  (void)run_.advance(kStart);
  EXPECT_THAT(run_.advance(kStart + 20 * kSecond).triggers, ElementsAre(kStopSymbol));
  EXPECT_EQ(run_.result().exit_code, kExitMissing);
  EXPECT_EQ(run_.result().reason,
            "after 20 s: missing: middleware_2; not ready: "
            "vehicle_raspberry_2");
}

TEST_F(RealTimeRunTest, EndsIfNobodyStarts) {
  make_ready();
  (void)run_.advance(kStart);
  for (Nanoseconds t = kStart; t < kStart + kStandbyTimeout; t += kPeriod) {
    const LabRunActions actions = advance_with_reports(t, coordination::StepStatus::kStandby,
                                                       coordination::StepStatus::kStandby);
    EXPECT_THAT(actions.deaths, IsEmpty());
  }
  EXPECT_EQ(run_.wake_up(), kStart + kStandbyTimeout);
  EXPECT_THAT(run_.advance(kStart + kStandbyTimeout).triggers, ElementsAre(kStopSymbol));
  EXPECT_EQ(run_.result().exit_code, kExitMissing);
  EXPECT_THAT(run_.result().reason, HasSubstr("high_level_controller_1"));
}

TEST_F(RealTimeRunTest, AControllerThatHangsIsNamedThoughItsParticipantLives) {
  make_ready();
  (void)run_.advance(kStart);
  Nanoseconds t = kStart + kSecond;
  (void)advance_with_reports(t, coordination::StepStatus::kPlanned,
                             coordination::StepStatus::kPlanned);
  const Nanoseconds due = t + RealTimeRun::kReportTimeout;
  for (t += kPeriod; t < due; t += kPeriod) {  // only controller 1 goes on
    run_.report(report(1, step_at(t, kPeriod), coordination::StepStatus::kPlanned));
    EXPECT_THAT(run_.advance(t).deaths, IsEmpty());
  }
  EXPECT_EQ(run_.wake_up(), due);
  const LabRunActions actions = run_.advance(due);
  ASSERT_EQ(actions.deaths.size(), 1U);
  EXPECT_EQ(actions.deaths.front().process, controller_name(2));
  EXPECT_EQ(actions.run_state, RunPhase::kMinimalRiskStop);
  EXPECT_EQ(run_.result().exit_code, kExitDied);
}

// Its lease ends up to 2 s after the last list; the library looks a little later.
TEST_F(RealTimeRunTest, AMiddlewareThatIsGoneIsNamedAndNotItsControllerThatGetsNoLists) {
  make_ready();
  (void)run_.advance(kStart);
  Nanoseconds t = kStart + kSecond;
  (void)advance_with_reports(t, coordination::StepStatus::kPlanned,
                             coordination::StepStatus::kPlanned);
  const Nanoseconds noticed = t + 2 * kSecond + kPeriod;
  for (t += kPeriod; t < noticed; t += kPeriod) {
    run_.report(report(1, step_at(t, kPeriod), coordination::StepStatus::kPlanned));
    EXPECT_THAT(run_.advance(t).deaths, IsEmpty());
  }
  std::set<std::string> others = kAll;
  others.erase(middleware_name(2));
  run_.presence(others, {middleware_name(2)});
  const LabRunActions actions = run_.advance(noticed);
  ASSERT_EQ(actions.deaths.size(), 1U);
  EXPECT_EQ(actions.deaths.front().process, middleware_name(2));
}

TEST_F(RealTimeRunTest, AControllerThatNeverReportsIsNamed) {
  make_ready();
  (void)run_.advance(kStart);
  const Nanoseconds due = kStart + kSecond + RealTimeRun::kReportTimeout;
  run_.report(report(1, step_at(due - 1, kPeriod), coordination::StepStatus::kPlanned));
  EXPECT_THAT(run_.advance(due - 1).deaths, IsEmpty());
  const LabRunActions actions = run_.advance(due);
  ASSERT_EQ(actions.deaths.size(), 1U);
  EXPECT_EQ(actions.deaths.front().process, controller_name(2));
}

TEST_F(RealTimeRunTest, AControllerThatStaysOnStandbyWhileOthersDriveIsNamed) {
  make_ready();
  (void)run_.advance(kStart);
  const Nanoseconds begin = kStart + kSecond;
  const Nanoseconds due = begin + RealTimeRun::kReportTimeout;
  for (Nanoseconds t = begin; t < due; t += kPeriod) {
    const LabRunActions actions = advance_with_reports(t, coordination::StepStatus::kPlanned,
                                                       coordination::StepStatus::kStandby);
    EXPECT_THAT(actions.deaths, IsEmpty());
  }
  const LabRunActions actions = advance_with_reports(due, coordination::StepStatus::kPlanned,
                                                     coordination::StepStatus::kStandby);
  ASSERT_EQ(actions.deaths.size(), 1U);
  EXPECT_EQ(actions.deaths.front().process, controller_name(2));
  EXPECT_EQ(run_.result().exit_code, kExitDied);
}

}  // namespace
}  // namespace hlc::lab_control::real_time_run_test
