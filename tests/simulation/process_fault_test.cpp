// A process of a real-time run is killed or stopped while its car is coupled with others: what all
// cars drove then is held against the plans that were agreed. One of each kind is run with real
// processes, too (tests/integration/fault_test.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "tests/integration/fault_records.hpp"
#include "tests/integration/fault_rules.hpp"
#include "tests/integration/run_reports.hpp"
#include "tests/simulation/observed_run.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::closed_loop::process_fault_test {
namespace {

constexpr Nanoseconds kSecond = kNanosecondsPerSecond;
constexpr Nanoseconds kPatience = 120 * kSecond;
constexpr std::uint64_t kStep_ns = kSecond / 5;

/// The three cars of the paper, driving.
class FaultyRun {
 public:
  FaultyRun(const std::string& scenario, Transport transport, std::uint64_t seed)
      : run(scenario_of(scenario), {.seed = seed, .transport = transport}) {}

  [[nodiscard]] bool drives_near_another(VehicleId victim) {
    records_.victim = victim;
    records_.tracking_tolerance_m = test::tracking_tolerance_m(run.scenario());
    return run.comes_to(
        [&] {
          return run.is_between_commands() && test::drives_near_another(run.reports(), victim) &&
                 test::is_newest_sent_whole(run.commands(), victim.value);
        },
        kPatience);
  }
  void strike(const std::string& process, bool is_killed) {
    records_.fault = run.now();
    is_killed ? run.kill(process) : run.freeze(process);
  }
  [[nodiscard]] Nanoseconds fault() const { return records_.fault; }

  /// The lab control is interrupted, and the run ends. @param dead  process that does not
  void end(const std::string& dead = "") {
    run.interrupt(kLabControlName);
    EXPECT_TRUE(run.comes_to([&] { return run.have_all_ended(dead); }, kPatience));
    EXPECT_EQ(run.violations(), "");
    test::expect_nobody_was_touched(run);
  }
  [[nodiscard]] const test::FaultRecords& records() {
    records_.drives = run.drives();
    records_.commands = run.commands();
    records_.reports = run.reports();
    return records_;
  }

  ObservedRun run;

 private:
  test::FaultRecords records_;
};

struct ProcessFault {
  std::string name;
  std::uint8_t victim;
  std::string process;
  bool is_killed;
};
void PrintTo(const ProcessFault& one, std::ostream* out) { *out << one.name; }

class LastingFault : public testing::TestWithParam<ProcessFault> {};

TEST_P(LastingFault, LeavesItsCarOnItsLastPlanAndStandingAndTheOthersKeepClear) {
  const ProcessFault& fault = GetParam();
  for (const bool is_lab : {false, true}) {
    for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(3); ++seed) {
      SCOPED_TRACE((is_lab ? "lab, seed " : "paper, seed ") + std::to_string(seed));
      FaultyRun one(is_lab ? "lab_three_cars" : "paper_three_cars",
                    is_lab ? Transport::kLab : Transport::kLoopback, seed);
      ASSERT_TRUE(one.drives_near_another({fault.victim}));
      one.strike(fault.process, fault.is_killed);
      one.run.pass(6 * kSecond);
      EXPECT_TRUE(one.run.has_logged(kLabControlName, fault.process + " died"));
      const test::FaultRecords records = one.records();
      test::expect_victim_drives_only_its_last_plan(records, test::kForever);
      test::expect_victim_stands(records);
      test::expect_others_keep_clear(records, one.run.scenario(), test::kForever);
      if (!fault.is_killed) one.run.resume(fault.process);  // it finds the run over, or goes on
      one.end(fault.is_killed ? fault.process : "");
      EXPECT_EQ(one.run.exit_codes().at(kLabControlName), kExitInterrupted);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, LastingFault,
    testing::Values(ProcessFault{"controller_killed", 2, controller_name(2), true},
                    ProcessFault{"controller_stopped", 2, controller_name(2), false},
                    ProcessFault{"middleware_killed", 2, middleware_name(2), true},
                    ProcessFault{"middleware_stopped", 2, middleware_name(2), false},
                    ProcessFault{"predecessor_killed", 1, controller_name(1), true}),
    testing::PrintToStringParamName());

// Too short to count as dead: planning continues when its messages arrive again.
TEST(PassingFault, AStoppedControllerThatGoesOnIsHeardAgainAndItsCarDrivesOn) {
  constexpr VehicleId kVictim{2};
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(3); ++seed) {
    FaultyRun one("paper_three_cars", Transport::kLoopback, seed);
    ASSERT_TRUE(one.drives_near_another(kVictim));
    one.strike(controller_name(2), false);
    one.run.pass(2 * test::kReactionTime);
    const auto last = test::last_report(one.run.reports(), {1});
    ASSERT_TRUE(last && test::is_among(kVictim, last->missing));
    one.run.resume(controller_name(2));
    const Nanoseconds goes_on = one.run.now();
    EXPECT_TRUE(one.run.comes_to(
        [&] {
          return test::planned_steps(one.run.reports(), kVictim, {goes_on / kStep_ns + 1}) >= 5;
        },
        5 * kSecond));
    EXPECT_FALSE(one.run.has_logged(kLabControlName, "died"));
    const test::FaultRecords records = one.records();
    test::expect_victim_drives_only_its_last_plan(records, goes_on);
    test::expect_others_keep_clear(records, one.run.scenario(), goes_on);
    one.end();
  }
}

// All consider it dead; it wakes up with old messages.
TEST(PassingFault, AControllerThatIsStoppedUntilAllStandHurtsNobodyWhenItGoesOn) {
  constexpr VehicleId kVictim{2};
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(3); ++seed) {
    FaultyRun one("paper_three_cars", Transport::kLoopback, seed);
    ASSERT_TRUE(one.drives_near_another(kVictim));
    one.strike(controller_name(2), false);
    ASSERT_TRUE(one.run.comes_to(
        [&] {
          return one.run.has_logged(kLabControlName, controller_name(2) + " died") &&
                 one.run.now() > one.fault() + test::kStandingTime;
        },
        kPatience));
    one.run.resume(controller_name(2));
    const Nanoseconds goes_on = one.run.now();
    one.run.pass(3 * kSecond);
    const test::FaultRecords records = one.records();
    test::expect_victim_drives_only_its_last_plan(records, goes_on);
    test::expect_others_keep_clear(records, one.run.scenario(), goes_on);
    one.end();
  }
}

// Its car stands at once; the others, which see it, plan around it or stop.
TEST(LastingFault, OfAVehicleHurtsNobodyAndIsNamed) {
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(3); ++seed) {
    FaultyRun one("paper_three_cars", Transport::kLoopback, seed);
    ASSERT_TRUE(one.drives_near_another({2}));
    one.strike(vehicle_name(2), true);
    one.run.pass(6 * kSecond);
    EXPECT_TRUE(one.run.has_logged(kLabControlName, vehicle_name(2) + " died"));
    one.run.interrupt(kLabControlName);
    EXPECT_TRUE(
        one.run.comes_to([&] { return one.run.have_all_ended(vehicle_name(2)); }, kPatience));
    EXPECT_EQ(one.run.violations(), "");
  }
}

TEST(LastingFault, OfTheLabControlLetsAllStandBeforeTheyLeave) {
  FaultyRun one("paper_three_cars", Transport::kLoopback, 1);
  ASSERT_TRUE(one.run.comes_to(
      [&] {
        return one.run.drives().size() == 3 &&
               std::ranges::all_of(one.run.drives(), [](const auto& drive) {
                 return drive.second.back().speed_mps > 0.5;
               });
      },
      kPatience));
  one.strike(kLabControlName, true);
  EXPECT_TRUE(one.run.comes_to([&] { return one.run.have_all_ended(kLabControlName); }, kPatience));
  EXPECT_THAT(one.run.exit_codes(), testing::Each(testing::Pair(testing::_, kExitDied)));
  EXPECT_EQ(one.run.violations(), "");
  test::expect_nobody_was_touched(one.run);
  for (const auto& [id, drive] : one.run.drives()) {
    EXPECT_LT(std::abs(drive.back().speed_mps), 0.05) << "vehicle " << int{id};
  }
}

}  // namespace
}  // namespace hlc::closed_loop::process_fault_test
