// Whole runs in logical time: ticks are released in order whatever the order of events; a process
// that dies, hangs or is missing blocks nobody and is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <random>
#include <set>

#include "hlc_bridge/lab_control/lab_run.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "tests/simulation/observed_run.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::closed_loop::logical_run_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Nanoseconds kSecond = kNanosecondsPerSecond;
constexpr Nanoseconds kPeriod = kSecond / 5;
/// For silent processes 10 s, for leases 10 s, for triggers a minute.
constexpr Nanoseconds kPatience = 180 * kSecond;
constexpr std::ptrdiff_t kBrakingTicks = 50;
/// Before that cars are on standby.
constexpr Nanoseconds kDriving = 7 * kPeriod;

class LogicalRun {
 public:
  LogicalRun(const std::string& scenario, std::uint64_t seed, std::uint64_t steps)
      : run(scenario_of(scenario), {.seed = seed, .is_logical = true, .steps = steps}) {}

  [[nodiscard]] bool drives_until(Nanoseconds tick) {
    return run.comes_to([&] { return run.tick() >= tick; }, kPatience);
  }
  [[nodiscard]] bool ends(const std::string& except = "") {
    return run.comes_to([&] { return run.have_all_ended(except); }, kPatience);
  }
  [[nodiscard]] std::optional<int> exit_code(const std::string& process) const {
    const auto found = run.exit_codes().find(process);
    return found == run.exit_codes().end() ? std::nullopt : std::optional(found->second);
  }

  enum class Way { kKilled, kStopped, kHangs };
  void let_die(const std::string& process, Way way) {
    switch (way) {
      case Way::kKilled:
        return run.kill(process);
      case Way::kStopped:
        return run.freeze(process);
      case Way::kHangs:
        return run.silence(process);
    }
  }

  struct Dead {
    std::string process;
    Nanoseconds tick{};
  };
  /// As the lab control names them.
  [[nodiscard]] std::vector<Dead> dead() {
    std::vector<Dead> dead;
    for (const ObservedRun::Line& line : run.log(kLabControlName)) {
      const std::size_t end = line.line.text.find(" died: ");
      if (end != std::string::npos) dead.push_back({line.line.text.substr(0, end), line.tick});
    }
    return dead;
  }

  ObservedRun run;
};

/// As far as they are not of a moment: their times differ by what was waited for.
std::vector<std::tuple<std::uint8_t, std::uint64_t, coordination::StepStatus>> steps_of(
    const ObservedRun& run) {
  std::vector<std::tuple<std::uint8_t, std::uint64_t, coordination::StepStatus>> steps;
  for (const ReportRecord& record : run.reports()) {
    steps.emplace_back(record.report.vehicle.value, record.report.step.value, record.report.status);
  }
  std::ranges::sort(steps);
  return steps;
}

/// Standby before step `first`, a new plan in each of the others before step `end`.
std::vector<std::tuple<std::uint8_t, std::uint64_t, coordination::StepStatus>> steps_of(
    std::uint8_t id, std::uint64_t first, std::uint64_t end) {
  std::vector<std::tuple<std::uint8_t, std::uint64_t, coordination::StepStatus>> steps;
  for (std::uint64_t step = 0; step < end; ++step) {
    steps.emplace_back(
        id, step,
        step < first ? coordination::StepStatus::kStandby : coordination::StepStatus::kPlanned);
  }
  return steps;
}

// Steps 6 ... 15 after standby, one period more, and a second of braking.
TEST(LogicalRun, ReleasesEveryTickInOrderWhateverTheOrderOfEvents) {
  constexpr std::uint64_t kSteps = 10;
  constexpr std::uint64_t kFirst = 6;
  constexpr std::uint64_t kEnd = kFirst + kSteps + 1;
  std::vector<Nanoseconds> expected;
  for (Nanoseconds t = 0; t <= kEnd * kPeriod + kSecond; t += kVehiclePeriod) expected.push_back(t);
  for (std::uint64_t seed = 0; seed < test::num_seeds(20); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    LogicalRun one(seed % 4 == 0 ? "paper_red_alone" : "paper_three_cars", seed, kSteps);
    one.run.on_tick = [&](std::uint8_t vehicle, Nanoseconds tick) {
      EXPECT_GE(tick, one.run.tick()) << "vehicle " << int{vehicle} << " had not answered";
    };
    ASSERT_TRUE(one.ends());
    EXPECT_EQ(one.run.violations(), "");
    EXPECT_THAT(one.run.exit_codes(), testing::Each(testing::Pair(testing::_, kExitGood)));
    EXPECT_EQ(one.run.stopped_at(), kEnd * kPeriod);

    std::vector<std::tuple<std::uint8_t, std::uint64_t, coordination::StepStatus>> steps;
    for (const auto& [id, drive] : one.run.drives()) {
      std::vector<Nanoseconds> ticks;
      for (const result::DrivenSample& sample : drive) ticks.push_back(sample.t);
      EXPECT_EQ(ticks, expected) << "vehicle " << int{id};
      std::ranges::copy(steps_of(id, kFirst, kEnd), std::back_inserter(steps));
    }
    EXPECT_EQ(steps_of(one.run), steps);
  }
}

/// The vehicle stood when the stop symbol came: so the plan stopped it, not the braking.
void expect_stood_before_the_stop(const result::Drive& drive) {
  ASSERT_GT(std::ssize(drive), kBrakingTicks);
  EXPECT_LT(std::abs(drive[drive.size() - 1 - kBrakingTicks].speed_mps), 0.05);
}

// Whichever process dies, at any time, in any way.
TEST(LogicalRun, ADeathBlocksNobodyAndIsNamedAndTheOthersStandBeforeTheStop) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(36); ++seed) {
    std::mt19937_64 random{seed};
    const auto id = static_cast<std::uint8_t>(1 + random() % 3);
    const std::string victim =
        std::vector{vehicle_name(id), middleware_name(id), controller_name(id)}[seed % 3];
    const Nanoseconds time = random() % (6 * kSecond);
    const auto way = static_cast<LogicalRun::Way>(seed / 3 % 3);
    constexpr std::array kWays{" killed", " stopped", " hangs"};
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + victim + " at " + std::to_string(time) +
                 kWays[seed / 3 % 3]);
    LogicalRun one("paper_three_cars", seed, 400);
    ASSERT_TRUE(one.drives_until(time));
    one.let_die(victim, way);
    ASSERT_TRUE(one.ends(victim));
    EXPECT_EQ(one.run.violations(), "");
    EXPECT_EQ(one.exit_code(kLabControlName), kExitDied);
    // A controller leaves when its middleware is lost; no other process is accused.
    const std::vector<LogicalRun::Dead> dead = one.dead();
    ASSERT_FALSE(dead.empty());
    EXPECT_EQ(one.run.last_line(kLabControlName).find("died: " + victim), 0U);
    for (const LogicalRun::Dead& other : dead) {
      EXPECT_TRUE(other.process == victim ||
                  (victim == middleware_name(id) && other.process == controller_name(id)))
          << other.process;
    }
    ASSERT_TRUE(one.run.stopped_at());
    EXPECT_NEAR(static_cast<double>(*one.run.stopped_at() - dead.front().tick), 3e9, 41e6);
    for (const auto& [number, drive] : one.run.drives()) {
      if (vehicle_name(number) == victim) continue;
      SCOPED_TRACE("vehicle " + std::to_string(number));
      EXPECT_GE(drive.back().t, *one.run.stopped_at() + kSecond - kVehiclePeriod);
      expect_stood_before_the_stop(drive);
      if (number == id || time < kDriving) continue;
      EXPECT_TRUE(std::ranges::any_of(one.run.reports(), [&](const ReportRecord& record) {
        return record.report.vehicle.value == number &&
               record.report.status == coordination::StepStatus::kMinimalRiskStop;
      }));
    }
  }
}

TEST(LogicalRun, EndsIfTheOnlyCarIsLost) {
  for (const std::string& victim : {vehicle_name(1), middleware_name(1), controller_name(1)}) {
    SCOPED_TRACE(victim);
    LogicalRun one("paper_red_alone", 3, 400);
    ASSERT_TRUE(one.drives_until(2 * kSecond));
    one.run.kill(victim);
    ASSERT_TRUE(one.ends(victim));
    EXPECT_EQ(one.exit_code(kLabControlName), kExitDied);
    EXPECT_EQ(one.run.last_line(kLabControlName).find("died: " + victim), 0U);
  }
}

TEST(LogicalRun, ADeadLabControlEndsEverybodyAfterItsLease) {
  for (const auto way : {LogicalRun::Way::kKilled, LogicalRun::Way::kStopped}) {
    LogicalRun one("paper_three_cars", 4, 400);
    ASSERT_TRUE(one.drives_until(3 * kSecond));
    one.let_die(kLabControlName, way);
    EXPECT_TRUE(
        one.run.comes_to([&] { return one.run.have_all_ended(kLabControlName); }, 30 * kSecond));
    EXPECT_THAT(one.run.exit_codes(), testing::Each(testing::Pair(testing::_, kExitDied)));
    EXPECT_EQ(one.run.violations(), "");
  }
}

TEST(LogicalRun, AProcessThatNeverAppearsIsNamedAndEverybodyEnds) {
  for (const std::string& victim : {vehicle_name(2), middleware_name(2), controller_name(2)}) {
    SCOPED_TRACE(victim);
    LogicalRun one("paper_three_cars", 5, 400);
    one.run.kill(victim);
    EXPECT_TRUE(one.ends(victim));
    EXPECT_EQ(one.exit_code(kLabControlName), kExitMissing);
    EXPECT_THAT(one.run.last_line(kLabControlName), HasSubstr("missing: "));
    EXPECT_THAT(one.run.last_line(kLabControlName), HasSubstr(victim));
    EXPECT_THAT(one.run.drives(), IsEmpty());
  }
}

TEST(LogicalRun, EndsIfNobodyLeavesStandby) {
  scenario::Scenario beside = scenario_of("paper_red_alone");
  beside.vehicles[0].start = compose(beside.vehicles[0].start, {0.0, 0.5, 0.0});  // on no route
  ObservedRun run(beside, {.seed = 6, .is_logical = true});
  ASSERT_TRUE(run.comes_to([&] { return run.have_all_ended(); }, kPatience));
  EXPECT_EQ(run.exit_codes().at(kLabControlName), kExitMissing);
  EXPECT_THAT(run.last_line(kLabControlName), HasSubstr("standby"));
  EXPECT_EQ(run.stopped_at(), lab_control::kStandbyTimeout);
}

TEST(LogicalRun, InterruptionStopsAtOnceAndLetsTheVehiclesBrake) {
  LogicalRun one("paper_three_cars", 7, 400);
  ASSERT_TRUE(one.drives_until(3 * kSecond));
  one.run.interrupt(kLabControlName);
  ASSERT_TRUE(one.ends());
  EXPECT_EQ(one.run.violations(), "");
  for (const auto& [process, code] : one.run.exit_codes()) {
    EXPECT_EQ(code, process == kLabControlName ? kExitInterrupted : kExitGood) << process;
  }
  EXPECT_LE(*one.run.stopped_at(), 3 * kSecond + 2 * kVehiclePeriod);
  EXPECT_GE(one.run.tick(), *one.run.stopped_at() + kSecond - kVehiclePeriod);
}

}  // namespace
}  // namespace hlc::closed_loop::logical_run_test
