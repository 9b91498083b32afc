#include "hlc_bridge/core/real_time_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/core/node_names.hpp"

namespace hlc {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kSecond = kNanosecondsPerSecond;
constexpr Nanoseconds kStart = 1'700'000'000 * kSecond;

LabRunSettings settings() { return {.vehicle_ids = {1, 2}, .period = kPeriod, .steps = 10}; }

const std::set<std::string> kAll{vehicle_name(1),    vehicle_name(2),    middleware_name(1),
                                 middleware_name(2), controller_name(1), controller_name(2)};

VehicleState state(std::uint8_t id) {
  VehicleState state;
  state.vehicle_id = id;
  return state;
}

ReportRecord report(std::uint8_t id, std::uint64_t step, StepStatus status) {
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
    run_.trigger_readers(4);
    for (const std::uint8_t id : settings().vehicle_ids) {
      run_.state(state(id));
      run_.ready({middleware_ready_id(id), 0});
    }
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
  run_.trigger_readers(4);
  run_.state(state(1));
  run_.ready({middleware_ready_id(1), 0});
  run_.state(state(2));
  EXPECT_THAT(run_.advance(kStart).triggers, IsEmpty());
  run_.ready({middleware_ready_id(2), 0});
  run_.trigger_readers(3);
  EXPECT_THAT(run_.advance(kStart + 1).triggers, IsEmpty());
  run_.trigger_readers(4);
  EXPECT_THAT(run_.advance(kStart + 2).triggers, ElementsAre(kStart + 2 + kSecond));
}

TEST_F(RealTimeRunTest, TimerNamesAreNoSignOfReadinessInRealTime) {
  run_.trigger_readers(4);
  for (const std::uint8_t id : settings().vehicle_ids) {
    run_.state(state(id));
    run_.ready({middleware_name(id), 0});
  }
  EXPECT_THAT(run_.advance(kStart).triggers, IsEmpty());
}

TEST_F(RealTimeRunTest, StopsOnePeriodAfterTheLastStepAndFinishesAfterBraking) {
  make_ready();
  (void)run_.advance(kStart);
  const std::uint64_t k0 = step_at(kStart + kSecond, kPeriod);
  run_.report(report(1, k0 - 1, StepStatus::kStandby));
  run_.report(report(1, k0, StepStatus::kPlanned));
  (void)run_.advance(kStart + kSecond);
  const Nanoseconds end = (k0 + 11) * kPeriod;
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

TEST_F(RealTimeRunTest, LostProcessIsNamedAndTheOthersDriveOut) {
  make_ready();
  (void)run_.advance(kStart);
  std::set<std::string> others = kAll;
  others.erase(middleware_name(2));
  run_.presence(others, {middleware_name(2)});
  const LabRunActions actions = run_.advance(kStart + 2 * kSecond);
  ASSERT_EQ(actions.deaths.size(), 1U);
  EXPECT_EQ(actions.deaths.front().process, middleware_name(2));
  EXPECT_EQ(actions.run_state, RunPhase::kDriveOut);
  EXPECT_THAT(actions.triggers, IsEmpty());
  EXPECT_EQ(run_.wake_up(), kStart + 5 * kSecond);
  EXPECT_THAT(run_.advance(kStart + 5 * kSecond).triggers, ElementsAre(kStopSymbol));
  // Everybody leaves as told: no further death.
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
  run_.state(state(1));
  run_.ready({middleware_ready_id(1), 0});
  (void)run_.advance(kStart);
  EXPECT_THAT(run_.advance(kStart + 20 * kSecond).triggers, ElementsAre(kStopSymbol));
  EXPECT_EQ(run_.result().exit_code, kExitMissing);
  EXPECT_EQ(run_.result().reason,
            "after 20 s: not there: middleware_2; not ready: "
            "vehicle_raspberry_2");
}

TEST_F(RealTimeRunTest, EndsIfNobodyStarts) {
  make_ready();
  (void)run_.advance(kStart);
  EXPECT_EQ(run_.wake_up(), kStart + kStandbyTimeout);
  EXPECT_THAT(run_.advance(kStart + kStandbyTimeout).triggers, ElementsAre(kStopSymbol));
  EXPECT_EQ(run_.result().exit_code, kExitMissing);
  EXPECT_THAT(run_.result().reason, HasSubstr("high_level_controller_1 (silent)"));
}

TEST_F(RealTimeRunTest, SilenceIsNoDeath) {
  make_ready();
  (void)run_.advance(kStart);
  run_.report(report(1, step_at(kStart + kSecond, kPeriod), StepStatus::kPlanned));
  EXPECT_THAT(run_.advance(kStart + 13 * kSecond).deaths, IsEmpty());
}

}  // namespace
}  // namespace hlc
