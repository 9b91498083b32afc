#include "hlc_bridge/lab_control/logical_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <utility>

#include "hlc_bridge/messages/node_names.hpp"
#include "tests/hlc_bridge/lab_control/timer_names.hpp"

namespace hlc::lab_control::logical_run_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kSecond = kNanosecondsPerSecond;

LabRunSettings settings(std::vector<std::uint8_t> ids, std::uint64_t steps) {
  return {.vehicle_ids = std::move(ids), .period = kPeriod, .steps = steps};
}

/// Until the stop symbol. Vehicle 1 reports in every step what it waits for.
/// @return wall time then
Nanoseconds drive(LogicalRun& run,
                  const std::function<coordination::Waiting(std::uint64_t step)>& waiting) {
  run.trigger_readers(timers_of({1}));
  run.ready({vehicle_name(1), 0});
  run.ready({middleware_name(1), kListOffset});
  Nanoseconds wall = 100;
  for (Nanoseconds next = 0; next != kStopSymbol && wall < 10'000; ++wall) {
    next = run.advance(wall).triggers.at(0);
    if (next % kPeriod == kListOffset) {
      const std::uint64_t step = step_at(next, kPeriod);
      ReportRecord record;
      record.report = {.vehicle = {1},
                       .step = {step},
                       .status = coordination::StepStatus::kPlanned,
                       .waiting = waiting(step)};
      run.report(record);
      run.ready({middleware_name(1), next + kPeriod});
    } else if (next != kStopSymbol) {
      run.ready({vehicle_name(1), next + kVehiclePeriod});
    }
  }
  return wall;
}

/// A vehicle that waits for another one from step `first` to step `last`.
std::function<coordination::Waiting(std::uint64_t)> between(std::uint64_t first,
                                                            std::uint64_t last) {
  return [first, last](std::uint64_t step) {
    if (step < first || step > last) return coordination::Waiting{};
    return coordination::Waiting{.vehicles = {{2}}, .since = {first}};
  };
}

TEST(LogicalRun, FailsIfAVehicleIsStuckAtTheEnd) {
  LogicalRun run{settings({1}, 120)};
  drive(run, between(10, 500));
  EXPECT_EQ(run.result().exit_code, kExitStuck);
  EXPECT_EQ(run.result().reason, "stuck at the end: vehicle 1, waiting for 2 for 22.0 s");
}

// The steps are 0 ... 119; the reports of the period after them do not count.
TEST(LogicalRun, SucceedsIfAVehicleWaitsForLessOrGotOn) {
  for (const auto& [first, last] : {std::pair{21, 500}, {10, 118}}) {
    LogicalRun run{settings({1}, 120)};
    drive(run, between(static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(last)));
    EXPECT_EQ(run.result().exit_code, kExitGood) << first;
    EXPECT_EQ(run.result().reason, "") << first;
  }
}

// Whole runs: tests/simulation/logical_run_test.cpp.
TEST(LogicalRun, EndsOnePeriodAfterItsStepsAndSaysHowLongTheyTook) {
  LogicalRun run{settings({1}, 2)};
  const Nanoseconds wall = drive(run, between(1, 0));
  EXPECT_EQ(run.result().first_step, 0U);
  EXPECT_EQ(run.result().clock, 3 * kPeriod);
  EXPECT_EQ(run.result().wall, wall - 101);
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

// A controller that was killed before the lab control had discovered it is missed by the others:
// those that waited for it were named dead, too.
TEST(LogicalRun, WhoIsAbsentIsDeadBeforeThoseThatMayWaitForIt) {
  const std::vector<std::uint8_t> ids{1, 2};
  LogicalRun run{settings(ids, 20)};
  run.presence({vehicle_name(1), middleware_name(1), controller_name(1), vehicle_name(2),
                middleware_name(2), controller_name(2)},
               {});
  run.trigger_readers(timers_of({1, 2}));
  for (const std::uint8_t id : ids) {
    run.ready({vehicle_name(id), 0});
    run.ready({middleware_name(id), kListOffset});
  }
  EXPECT_THAT(run.advance(1).triggers, ElementsAre(0));
  run.presence({vehicle_name(1), middleware_name(1), controller_name(1), vehicle_name(2),
                middleware_name(2)},
               {});
  for (const std::uint8_t id : ids) run.ready({vehicle_name(id), kPeriod});
  EXPECT_THAT(run.advance(2).triggers, ElementsAre(kListOffset));
  for (const std::uint8_t id : ids) run.ready({middleware_name(id), kPeriod + kListOffset});
  EXPECT_THAT(run.advance(3).deaths, IsEmpty());
  const LabRunActions overdue = run.advance(3 + kAnswerTimeout);
  ASSERT_EQ(overdue.deaths.size(), 1U);
  EXPECT_EQ(overdue.deaths.front().process, controller_name(2));
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

TEST(LogicalRun, AProcessOfSeveralVehiclesAnswersForAllInOneMessage) {
  LogicalRun run{settings({1, 2}, 20)};
  run.trigger_readers(timers_of({1, 2}));
  const std::vector<std::uint8_t> ids{1, 2};
  run.ready({vehicle_name(ids), 0});
  run.ready({middleware_name(ids), kListOffset});
  EXPECT_THAT(run.advance(1).triggers, ElementsAre(0));
  EXPECT_EQ(run.pending_answers(), 1U) << "a message, though of two vehicles";
  run.ready({vehicle_name(ids), kPeriod});
  EXPECT_THAT(run.advance(2).triggers, ElementsAre(kListOffset));
  EXPECT_EQ(run.pending_answers(), 1U);
}

TEST(LogicalRun, ATickWaitsForTheReportsOfTheListBefore) {
  LogicalRun run{settings({1}, 20)};
  run.trigger_readers(timers_of({1}));
  run.ready({vehicle_name(1), 0});
  run.ready({middleware_name(1), kListOffset});
  EXPECT_THAT(run.advance(1).triggers, ElementsAre(0));
  run.ready({vehicle_name(1), kVehiclePeriod});
  EXPECT_THAT(run.advance(2).triggers, ElementsAre(kListOffset));
  run.ready({middleware_name(1), kPeriod + kListOffset});
  EXPECT_THAT(run.advance(3).triggers, IsEmpty());
  EXPECT_EQ(run.pending_answers(), 1U);
  ReportRecord record;
  record.report.vehicle = VehicleId{1};
  run.report(record);
  EXPECT_THAT(run.advance(4).triggers, ElementsAre(kVehiclePeriod));
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

/// A guest has a vehicle, but neither controller nor middleware.
TEST(LogicalRunWithAGuest, AwaitsItsVehicleAndItsTicksAlone) {
  LabRunSettings with_guest = settings({1}, 5);
  with_guest.guest_ids = {9};
  LogicalRun run(with_guest);
  std::set<std::string> alive{vehicle_name(1), middleware_name(1), controller_name(1)};
  run.presence(alive, {});
  EXPECT_THAT(run.advance(0).triggers, IsEmpty());
  EXPECT_THAT(run.waiting_for(), HasSubstr("missing: " + vehicle_name(9)));
  alive.insert(vehicle_name(9));
  run.presence(alive, {});
  run.trigger_readers({vehicle_name(1), middleware_name(1), vehicle_name(9)});
  run.ready({vehicle_name(1), 0});
  run.ready({middleware_name(1), kListOffset});
  EXPECT_THAT(run.advance(1).triggers, IsEmpty());
  EXPECT_THAT(run.waiting_for(), HasSubstr("not ready: " + vehicle_name(9)));
  run.ready({vehicle_name(9), 0});
  EXPECT_THAT(run.advance(2).triggers, ElementsAre(0U));
}

}  // namespace
}  // namespace hlc::lab_control::logical_run_test
