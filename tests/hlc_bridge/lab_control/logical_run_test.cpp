#include "hlc_bridge/lab_control/logical_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hlc_bridge/lab_control/simulated_lab.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::lab_control::logical_run_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kSecond = kNanosecondsPerSecond;

LabRunSettings settings(std::vector<std::uint8_t> ids, std::uint64_t steps) {
  return {.vehicle_ids = std::move(ids), .period = kPeriod, .steps = steps};
}

TEST(LogicalRun, ReleasesEveryTickInOrderWhateverTheOrderOfEvents) {
  for (unsigned seed = 0; seed < test::num_seeds(30); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::size_t n = 1 + seed % 4;
    std::vector<std::uint8_t> ids;
    for (std::size_t i = 0; i < n; ++i) {
      ids.push_back(static_cast<std::uint8_t>(i + 1));
    }
    SimulatedLab lab{settings(ids, 10), seed};
    ASSERT_TRUE(lab.run());
    EXPECT_THAT(lab.violations(), IsEmpty());
    EXPECT_EQ(lab.result().exit_code, kExitGood);
    EXPECT_EQ(lab.result().first_step, 5U);
    // Steps 5 ... 14, one period more, and every tick of it: 16 lists and one vehicle tick per 20
    // ms.
    EXPECT_EQ(lab.stopped_at(), 16 * kPeriod);
    std::vector<Nanoseconds> expected;
    for (Nanoseconds t = 0; t <= 16 * kPeriod + kSecond; t += kVehiclePeriod) {
      expected.push_back(t);
      if (t % kPeriod == 0 && t < 16 * kPeriod) {
        expected.push_back(t + kListOffset);
      }
    }
    EXPECT_EQ(lab.released(), expected);
    for (const std::uint8_t id : ids) {
      EXPECT_EQ(lab.last_report(id), 15U);
    }
  }
}

// Property: if any process dies, at any time, in any way: nothing blocks, the dead process is
// named, the live ones continue for three seconds.
TEST(LogicalRun, DeathsDoNotBlockAndAreNamed) {
  for (unsigned seed = 0; seed < test::num_seeds(120); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random{seed};
    SimulatedLab lab{settings({1, 2, 3}, 20), seed};
    const auto id = static_cast<std::uint8_t>(1 + random() % 3);
    const std::vector<std::string> kinds{vehicle_name(id), middleware_name(id),
                                         controller_name(id)};
    SimulatedLab::Fault fault;
    fault.process = kinds[seed % 3];
    fault.time = random() % (4 * kSecond);
    fault.dying = random() % 2 == 0 ? SimulatedLab::Dying::kVanishes : SimulatedLab::Dying::kHangs;
    lab.set_fault(fault);
    SCOPED_TRACE(fault.process + " at " + std::to_string(fault.time));
    ASSERT_TRUE(lab.run());
    EXPECT_THAT(lab.violations(), IsEmpty());
    EXPECT_EQ(lab.result().exit_code, kExitDied);
    ASSERT_FALSE(lab.result().deaths.empty());
    EXPECT_EQ(lab.result().deaths.front().process, fault.process);
    EXPECT_THAT(lab.result().reason, StartsWith("died: " + fault.process));
    // A controller leaves when its middleware is lost; no other process is accused.
    for (std::size_t i = 1; i < lab.result().deaths.size(); ++i) {
      EXPECT_EQ(fault.process, middleware_name(id));
      EXPECT_EQ(lab.result().deaths[i].process, controller_name(id));
    }
    ASSERT_TRUE(lab.death_reported_at() && lab.stopped_at());
    EXPECT_NEAR(static_cast<double>(*lab.stopped_at() - *lab.death_reported_at()), 3e9, 21e6);
    EXPECT_GE(lab.released().back() + kListOffset, *lab.stopped_at() + kSecond);
  }
}

TEST(LogicalRun, RunEndsIfTheOnlyCarIsLost) {
  for (const std::string& process : {vehicle_name(1), middleware_name(1), controller_name(1)}) {
    SCOPED_TRACE(process);
    SimulatedLab lab{settings({1}, 20), 3};
    lab.set_fault({.process = process, .time = 2 * kSecond});
    ASSERT_TRUE(lab.run());
    EXPECT_EQ(lab.result().exit_code, kExitDied);
    EXPECT_EQ(lab.result().deaths.front().process, process);
  }
}

TEST(LogicalRun, EndsIfNobodyLeavesStandby) {
  SimulatedLab lab{settings({1, 2}, 20), 5};
  lab.set_first_step(std::nullopt);
  ASSERT_TRUE(lab.run());
  EXPECT_EQ(lab.result().exit_code, kExitMissing);
  EXPECT_THAT(lab.result().reason, HasSubstr("standby"));
  EXPECT_EQ(lab.stopped_at(), kStandbyTimeout);
}

TEST(LogicalRun, InterruptionStopsAtOnceAndLetsTheVehiclesBrake) {
  SimulatedLab lab{settings({1, 2}, 20), 7};
  lab.interrupt_at(2 * kSecond);
  ASSERT_TRUE(lab.run());
  EXPECT_THAT(lab.violations(), IsEmpty());
  EXPECT_EQ(lab.result().exit_code, kExitInterrupted);
  EXPECT_EQ(lab.stopped_at(), 2 * kSecond);
  EXPECT_GE(lab.released().back(), 3 * kSecond - kVehiclePeriod);
}

TEST(LogicalRun, InterruptedRunEndsInTimeEvenIfNobodyAnswers) {
  LogicalRun run{settings({1}, 20)};
  run.trigger_readers(timers_of({1}));
  run.ready({vehicle_name(1), 0});
  run.ready({middleware_name(1), kListOffset});
  EXPECT_THAT(run.advance(100).triggers, ElementsAre(0));
  run.interrupt();
  EXPECT_THAT(run.advance(200).triggers, ElementsAre(kStopSymbol));
  EXPECT_EQ(run.wake_up(), 200 + kInterruptTime);
  EXPECT_THAT(run.advance(run.wake_up()).triggers, IsEmpty());
  EXPECT_TRUE(run.finished());
}

TEST(LogicalRun, NamesWhoDidNotAppearAndWhoIsNotReady) {
  LogicalRun run{settings({1, 2}, 20)};
  run.trigger_readers(timers_of({1, 2}));
  run.presence({vehicle_name(1), middleware_name(1), controller_name(1), vehicle_name(2),
                middleware_name(2)},
               {});
  run.ready({vehicle_name(1), 0});
  run.ready({middleware_name(1), kListOffset});
  run.ready({vehicle_name(2), 0});
  EXPECT_THAT(run.advance(1000).triggers, IsEmpty());
  EXPECT_EQ(run.wake_up(), 1000 + 20 * kSecond);
  EXPECT_THAT(run.advance(run.wake_up() - 1).triggers, IsEmpty());
  EXPECT_FALSE(run.finished());
  EXPECT_THAT(run.advance(run.wake_up()).triggers, ElementsAre(kStopSymbol));
  EXPECT_TRUE(run.finished());
  EXPECT_EQ(run.result().exit_code, kExitMissing);
  EXPECT_EQ(run.result().reason,
            "after 20 s: missing: high_level_controller_2; not ready: middleware_2");
}

TEST(LogicalRun, ProcessThatIsLostBeforeTheStartMayComeBack) {
  LogicalRun run{settings({1}, 20)};
  run.trigger_readers(timers_of({1}));
  run.ready({vehicle_name(1), 0});
  run.presence({}, {vehicle_name(1)});
  EXPECT_THAT(run.advance(1).triggers, IsEmpty());
  run.presence({vehicle_name(1)}, {});
  run.ready({middleware_name(1), kListOffset});
  EXPECT_THAT(run.advance(2).triggers, IsEmpty());
  run.ready({vehicle_name(1), 0});
  EXPECT_THAT(run.advance(3).triggers, ElementsAre(0));
}

TEST(LogicalRun, FirstTriggerWaitsUntilItReachesEveryTimer) {
  LogicalRun run{settings({1}, 20)};
  run.presence({vehicle_name(1), middleware_name(1), controller_name(1)}, {});
  run.trigger_readers({vehicle_name(1), "recorder"});
  run.ready({vehicle_name(1), 0});
  run.ready({middleware_name(1), kListOffset});
  EXPECT_THAT(run.advance(1).triggers, IsEmpty()) << "two readers, but not the two timers'";
  EXPECT_THAT(run.waiting_for(), HasSubstr("triggers, not yet matched by middleware_1"));
  run.trigger_readers(timers_of({1}));
  EXPECT_THAT(run.advance(2).triggers, ElementsAre(0));
}

TEST(LogicalRun, ControllerWithoutMiddlewareOwesNoReports) {
  LogicalRun run{settings({1}, 20)};
  run.trigger_readers(timers_of({1}));
  run.ready({vehicle_name(1), 0});
  run.ready({middleware_name(1), kListOffset});
  EXPECT_THAT(run.advance(1).triggers, ElementsAre(0));
  run.ready({vehicle_name(1), kVehiclePeriod});
  EXPECT_THAT(run.advance(2).triggers, ElementsAre(kListOffset));
  run.presence({controller_name(1), vehicle_name(1)}, {middleware_name(1)});
  EXPECT_THAT(run.advance(3).triggers, ElementsAre(kVehiclePeriod));
}

TEST(LogicalRun, LostTriggerIsSentAgain) {
  LogicalRun run{settings({1}, 20)};
  run.trigger_readers(timers_of({1}));
  run.ready({vehicle_name(1), 0});
  run.ready({middleware_name(1), kListOffset});
  EXPECT_THAT(run.advance(1).triggers, ElementsAre(0));
  EXPECT_THAT(run.advance(2).triggers, IsEmpty());
  run.ready({vehicle_name(1), 0});
  EXPECT_THAT(run.advance(3).triggers, ElementsAre(0));
  run.ready({middleware_name(1), kListOffset});  // not due: waits for a later tick
  EXPECT_THAT(run.advance(4).triggers, IsEmpty());
}

TEST(LogicalRun, NothingIsReleasedBeforeAllAnswersOwedHaveCome) {
  LogicalRun run{settings({1, 2}, 20)};
  EXPECT_EQ(run.pending_answers(), 0U) << "before the beginning anything may count";
  run.trigger_readers(timers_of({1, 2}));
  for (const std::uint8_t id : std::vector<std::uint8_t>{1, 2}) {
    run.ready({vehicle_name(id), 0});
    run.ready({middleware_name(id), kListOffset});
  }
  EXPECT_THAT(run.advance(1).triggers, ElementsAre(0));
  EXPECT_EQ(run.pending_answers(), 2U);
  run.ready({vehicle_name(1), kVehiclePeriod});
  EXPECT_THAT(run.advance(2).triggers, IsEmpty());
  EXPECT_EQ(run.pending_answers(), 1U);
  run.ready({vehicle_name(2), kVehiclePeriod});
  EXPECT_THAT(run.advance(3).triggers, ElementsAre(kListOffset));
  EXPECT_EQ(run.pending_answers(), 2U);
}

TEST(LogicalRun, ControllersStopRequestEndsTheRun) {
  LogicalRun run{settings({1, 2}, 20)};
  run.trigger_readers(timers_of({1, 2}));
  for (const std::uint8_t id : std::vector<std::uint8_t>{1, 2}) {
    run.ready({vehicle_name(id), 0});
    run.ready({middleware_name(id), kListOffset});
  }
  EXPECT_THAT(run.advance(1).triggers, ElementsAre(0));
  run.stop_requested(2);
  EXPECT_EQ(run.advance(2).triggers.front(), kStopSymbol);
  EXPECT_EQ(run.result().exit_code, kExitDied);
  EXPECT_EQ(run.result().reason, "high_level_controller_2 requested the stop");
}

}  // namespace
}  // namespace hlc::lab_control::logical_run_test
