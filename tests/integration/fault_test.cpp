// A process of a real-time run is killed or stopped while its car is coupled with others: what all
// cars drove then, by their own records, is held against the plans that were agreed. One run of
// each kind: tests/simulation/process_fault_test.cpp makes the same claims for all processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "hlc_bridge/time/real_time.hpp"
#include "tests/integration/fault_records.hpp"
#include "tests/integration/fault_rules.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/integration/run_reports.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

constexpr Nanoseconds kPeriod = 200'000'000;

/// The three cars of the paper, driving; all in real time.
class FaultyRun {
 public:
  FaultyRun(const std::string& scenario, const std::string& transport)
      : lab({.scenario = scenario,
             .steps = 1000,  // longer than the cars take to meet
             .simulated_time = false,
             .transport = transport,
             .records_commands = true}) {
    lab.start_all();
  }

  /// Waits until the cars have driven for a while and `victim` is coupled with one that is near
  /// enough to be affected. False if that never comes.
  [[nodiscard]] bool drives_near_another(VehicleId victim) {
    return eventually(120s, [&] { return test::drives_near_another(lab.reports(), victim); });
  }

  /// Not between a command and its copy: a death there leaves a car without the rest of the plan.
  void strike(VehicleId victim, const std::string& process, int signal) {
    records.victim = victim;
    records.tracking_tolerance_m = tracking_tolerance_m(lab.scenario());
    EXPECT_TRUE(
        eventually(60s, [&] { return is_newest_sent_whole(lab.commands(), victim.value); }));
    lab[process].send(signal);
    records.fault = time::real_time_now();
  }

  /// To be called when the run has ended, before anything is asked of the records. No run has a
  /// collision.
  void read() {
    records.drives = lab.drives();
    records.commands = lab.commands();
    records.reports = lab.reports();
    ASSERT_EQ(records.drives.size(), 3U);
    expect_nobody_was_touched(lab);
  }

  LabProcesses lab;
  FaultRecords records;
};

// As in the lab: its transport, automaton and commands.
TEST(LastingFault, OfAControllerLeavesItsCarOnItsLastPlanAndStandingAndTheOthersKeepClear) {
  constexpr VehicleId kVictim{2};
  FaultyRun run("lab_three_cars", "lab");
  ASSERT_TRUE(run.drives_near_another(kVictim)) << run.lab.log("lab_control");
  run.strike(kVictim, "high_level_controller_2", SIGKILL);
  EXPECT_EQ(run.lab["lab_control"].wait_for(60s), 4) << run.lab.log("lab_control");
  EXPECT_THAT(run.lab.still_running_after(60s), testing::IsEmpty());

  run.read();
  if (!is_newest_sent_whole(run.records.commands, kVictim.value)) {
    GTEST_SKIP() << "on a busy machine the fault came between a command and its copy";
  }
  expect_victim_drives_only_its_last_plan(run.records, kForever);
  expect_victim_stands(run.records);
  expect_others_keep_clear(run.records, run.lab.scenario(), kForever);
}

// Too short to count as dead: planning continues when its messages arrive again.
TEST(PassingFault, AStoppedControllerThatGoesOnIsHeardAgainAndItsCarDrivesOn) {
  constexpr VehicleId kVictim{2};
  constexpr Nanoseconds kNotYetDead = 1'500'000'000;  // the others' patience is 2 s
  FaultyRun run("paper_three_cars", "loopback");
  ASSERT_TRUE(run.drives_near_another(kVictim)) << run.lab.log("lab_control");
  run.strike(kVictim, "high_level_controller_2", SIGSTOP);
  const auto is_missed = [&] {
    const std::optional<coordination::Report> last = last_report(run.lab.reports(), {1});
    return last && is_among(kVictim, last->missing) &&
           time::real_time_now() > run.records.fault + 2 * kReactionTime;
  };
  const bool was_missed = eventually(60s, is_missed);
  const Nanoseconds goes_on = time::real_time_now();
  run.lab["high_level_controller_2"].send(SIGCONT);
  ASSERT_TRUE(was_missed);
  const StepIndex after{goes_on / kPeriod + 1};
  const bool drives_on = eventually(60s, [&] {
    return planned_steps(run.lab.reports(), kVictim, after) >= 5 ||
           run.lab["lab_control"].wait_for(0ms);
  });
  run.lab["lab_control"].send(SIGINT);
  EXPECT_THAT(run.lab.still_running_after(60s), testing::IsEmpty());

  run.read();
  expect_victim_drives_only_its_last_plan(run.records, goes_on);
  expect_others_keep_clear(run.records, run.lab.scenario(), goes_on);
  if (goes_on >= run.records.fault + kNotYetDead) {
    GTEST_SKIP() << "a busy machine made the stop last " << goes_on - run.records.fault
                 << " ns: too long for its messages to count";
  }
  EXPECT_TRUE(drives_on);
  EXPECT_GE(planned_steps(run.records.reports, kVictim, after), 5U) << run.lab.log("lab_control");
}

}  // namespace
}  // namespace hlc::test
