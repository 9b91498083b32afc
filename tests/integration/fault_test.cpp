// A process of a real-time run is killed or stopped while its car is coupled with others: what all
// cars drove then, by their own records, is held against the plans that were agreed. In the paper's
// run, where nothing leaves the machine, and as in the lab: its transport, automaton and commands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "tests/integration/fault_rules.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/integration/run_reports.hpp"
#include "vehicle_sim/tracking/trajectory.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr double kCarWidth_m = 0.107;

struct Setting {
  std::string name;
  std::string scenario;
  std::string transport;
};

const Setting kPaper{"paper", "paper_three_cars", "loopback"};
const Setting kLab{"lab", "lab_three_cars", "lab"};

/// The three cars of the paper, driving; all in real time.
class FaultyRun {
 public:
  explicit FaultyRun(const Setting& setting = kPaper)
      : lab({.scenario = setting.scenario,
             .steps = 1000,  // longer than the cars take to meet
             .simulated_time = false,
             .transport = setting.transport,
             .records_commands = true}) {
    lab.start_all();
  }

  /// Waits until the cars have driven for a while and `victim` is coupled with one that is near
  /// enough to be affected. False if that never comes.
  [[nodiscard]] bool drives_near_another(VehicleId victim) {
    return eventually(120s, [&] {
      const std::vector<ReportRecord> so_far = lab.reports();
      const std::optional<coordination::Report> own = last_report(so_far, victim);
      if (planned_steps(so_far, victim) < 10 || !own) return false;
      return std::ranges::any_of(own->coupled, [&](VehicleId other) {
        const std::optional<coordination::Report> near = last_report(so_far, other);
        return near && distance_m(near->planned_pose, own->planned_pose) < kNear_m;
      });
    });
  }

  /// Not between a command and its copy: a death there leaves a car without the rest of the plan.
  void strike(VehicleId victim, const std::string& process, int signal) {
    victim_ = victim;
    EXPECT_TRUE(
        eventually(60s, [&] { return is_newest_sent_whole(lab.commands(), victim.value); }));
    lab[process].send(signal);
    fault = time::real_time_now();
  }

  /// To be called when the run has ended, before anything is asked of the records. No run has a
  /// collision.
  void read() {
    drives = lab.drives();
    commands = lab.commands();
    records = lab.reports();
    ASSERT_EQ(drives.size(), 3U);
    expect_nobody_was_touched(lab);
  }

  /// The car whose own process is hit cannot get a new plan.
  void expect_victim_drives_only_its_last_plan(Nanoseconds to) const {
    expect_only_the_last_plan(drives.at(victim_.value), commands, victim_.value, fault, to);
  }
  void expect_victim_stands() const {
    expect_stands_in_time(drives.at(victim_.value), victim_.value, fault);
  }

  /// The others are affected as long as everything that they could plan may meet the silent car:
  /// they drive only their last plans, and stand in time unless they get out of its reach. What
  /// they plan again keeps clear of all that the silent car could do.
  void expect_others_keep_clear(Nanoseconds to) const {
    std::size_t judged = 0;
    for (const auto& [id, drive] : drives) {
      if (id == victim_.value) continue;
      SCOPED_TRACE("vehicle " + std::to_string(id));
      const std::optional<StepIndex> fell_back = first_step(id, false);
      ASSERT_TRUE(fell_back || first_step(id, true)) << "it never missed the silent one";
      if (!fell_back) continue;
      const std::optional<StepIndex> planned_again = first_step(id, true, *fell_back);
      // What is planned in a step is driven from the next one on.
      const Nanoseconds free = planned_again ? (planned_again->value + 1) * kPeriod : kForever;
      const Nanoseconds until = std::min(free, to);
      if (fell_back->value * kPeriod > fault + kReactionTime) continue;  // came near later
      if (until > fault + kReactionTime) {
        expect_only_the_last_plan(drive, commands, id, fault, until);
        ++judged;
      }
      if (until > fault + kStandingTime && to == kForever) {
        const auto since = standing_since(drive, fault + kStandingTime + kVehiclePeriod);
        EXPECT_TRUE(since && *since <= fault + kStandingTime);
      }
    }
    judged += expect_new_plans_keep_clear();
    EXPECT_GT(judged, 0U) << "neither a minimal-risk stop nor a new plan";
  }

  LabProcesses lab;
  Nanoseconds fault{};
  result::Drives drives;
  Commands commands;
  std::vector<ReportRecord> records;

 private:
  /// So near that at first nothing new can be planned, mostly: the silent car may be anywhere
  /// within 1.6 m at the end of a plan.
  static constexpr double kNear_m = 0.5;

  static double distance_m(const Pose& a, const Pose& b) {
    return (a.position_m() - b.position_m()).norm();
  }

  /// The first step in which the vehicle missed the silent one and had a new plan, or had none.
  [[nodiscard]] std::optional<StepIndex> first_step(std::uint8_t vehicle, bool has_planned,
                                                    StepIndex from = {}) const {
    std::optional<StepIndex> first;
    for (const ReportRecord& record : records) {
      const coordination::Report& report = record.report;
      const bool fits = report.vehicle.value == vehicle && report.step >= from &&
                        is_among(victim_, report.missing) &&
                        has_planned == (report.status == coordination::StepStatus::kPlanned);
      if (fits && (!first || report.step < *first)) first = report.step;
    }
    return first;
  }

  /// Of every plan that was agreed while the silent car was missing, j steps ahead: it is farther
  /// from where that car was seen than that car, driving at its top speed, can have come. Not once
  /// it has stood for so long that it counts as an obstacle (missing.hpp).
  /// @return how many plans there were
  [[nodiscard]] std::size_t expect_new_plans_keep_clear() const {
    std::size_t num_plans = 0;
    constexpr Nanoseconds kStandsForGood = 2'000'000'000;
    const double top_speed_mps = top_speed_of(lab.scenario());
    for (const ReportRecord& record : records) {
      const coordination::Report& report = record.report;
      if (report.status != coordination::StepStatus::kPlanned || !is_among(victim_, report.missing))
        continue;
      const Nanoseconds now = report.step.value * kPeriod;
      const auto seen = result::driven_pose_at(drives.at(victim_.value), now - kStateDelay);
      const auto stands = standing_since(drives.at(victim_.value), now);
      const auto command = commands.find({report.vehicle.value, now + kListOffset});
      if (!seen || command == commands.end() || (stands && *stands + kStandsForGood < now)) {
        continue;
      }
      ++num_plans;
      for (std::uint64_t j = 1; j <= lab.scenario().horizon_steps; ++j) {
        const auto planned = tracking::sample(command->second.points, now + j * kPeriod);
        if (!planned) {
          ADD_FAILURE() << "command of step " << report.step.value << " ends before its plan";
          break;
        }
        const double reach_m = top_speed_mps * 1e-9 * static_cast<double>(j * kPeriod);
        EXPECT_GT((planned->position_m - seen->position_m()).norm(), reach_m + kCarWidth_m)
            << "vehicle " << int{report.vehicle.value} << ", step " << report.step.value << " + "
            << j;
      }
    }
    return num_plans;
  }

  static double top_speed_of(const scenario::Scenario& scenario) {
    double top_mps = 0.0;
    for (const automaton::Trim& trim : scenario.subgraph->automaton().trims) {
      top_mps = std::max(top_mps, trim.speed_mps);
    }
    return top_mps;
  }

  VehicleId victim_;
};

struct Fault {
  std::string name;
  Setting setting;
  VehicleId victim;
  std::string process;
  int signal;
};
void PrintTo(const Fault& one, std::ostream* out) { *out << one.name << "_" << one.setting.name; }

class LastingFault : public testing::TestWithParam<Fault> {};

TEST_P(LastingFault, LeavesItsCarOnItsLastPlanAndStandingAndTheOthersKeepClear) {
  const Fault& fault = GetParam();
  FaultyRun run(fault.setting);
  ASSERT_TRUE(run.drives_near_another(fault.victim)) << run.lab.log("lab_control");
  run.strike(fault.victim, fault.process, fault.signal);
  EXPECT_EQ(run.lab["lab_control"].wait_for(60s), 4) << run.lab.log("lab_control");
  run.lab[fault.process].send(SIGCONT);  // it finds the run over
  EXPECT_THAT(run.lab.still_running_after(60s), testing::IsEmpty());

  run.read();
  if (!is_newest_sent_whole(run.commands, fault.victim.value)) {
    GTEST_SKIP() << "on a busy machine the fault came between a command and its copy";
  }
  run.expect_victim_drives_only_its_last_plan(kForever);
  run.expect_victim_stands();
  run.expect_others_keep_clear(kForever);
}

INSTANTIATE_TEST_SUITE_P(
    All, LastingFault,
    testing::Values(Fault{"controller_killed", kPaper, {2}, "high_level_controller_2", SIGKILL},
                    Fault{"controller_stopped", kPaper, {2}, "high_level_controller_2", SIGSTOP},
                    Fault{"middleware_killed", kPaper, {2}, "middleware_2", SIGKILL},
                    Fault{"middleware_stopped", kPaper, {2}, "middleware_2", SIGSTOP},
                    Fault{"predecessor_killed", kPaper, {1}, "high_level_controller_1", SIGKILL},
                    Fault{"controller_killed", kLab, {2}, "high_level_controller_2", SIGKILL},
                    Fault{"controller_stopped", kLab, {2}, "high_level_controller_2", SIGSTOP},
                    Fault{"middleware_killed", kLab, {2}, "middleware_2", SIGKILL}),
    testing::PrintToStringParamName());

// Too short to count as dead: planning continues when its messages arrive again.
TEST(PassingFault, AStoppedControllerThatGoesOnIsHeardAgainAndItsCarDrivesOn) {
  constexpr VehicleId kVictim{2};
  constexpr Nanoseconds kNotYetDead = 1'500'000'000;  // the others' patience is 2 s
  FaultyRun run;
  ASSERT_TRUE(run.drives_near_another(kVictim)) << run.lab.log("lab_control");
  run.strike(kVictim, "high_level_controller_2", SIGSTOP);
  const auto is_missed = [&] {
    const std::optional<coordination::Report> last = last_report(run.lab.reports(), {1});
    return last && is_among(kVictim, last->missing) &&
           time::real_time_now() > run.fault + 2 * kReactionTime;
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
  run.expect_victim_drives_only_its_last_plan(goes_on);
  run.expect_others_keep_clear(goes_on);
  if (goes_on >= run.fault + kNotYetDead) {
    GTEST_SKIP() << "a busy machine made the stop last " << goes_on - run.fault
                 << " ns: too long for its messages to count";
  }
  EXPECT_TRUE(drives_on);
  EXPECT_GE(planned_steps(run.records, kVictim, after), 5U) << run.lab.log("lab_control");
}

// All consider it dead and make a minimal-risk stop; it wakes up with old messages.
TEST(PassingFault, AControllerThatIsStoppedUntilAllStandHurtsNobodyWhenItGoesOn) {
  constexpr VehicleId kVictim{2};
  FaultyRun run;
  ASSERT_TRUE(run.drives_near_another(kVictim)) << run.lab.log("lab_control");
  run.strike(kVictim, "high_level_controller_2", SIGSTOP);
  const bool was_dead = eventually(60s, [&] {
    const std::optional<coordination::Report> last = last_report(run.lab.reports(), {1});
    return last && last->status == coordination::StepStatus::kMinimalRiskStop &&
           time::real_time_now() > run.fault + kStandingTime;
  });
  const Nanoseconds goes_on = time::real_time_now();
  run.lab["high_level_controller_2"].send(SIGCONT);
  ASSERT_TRUE(was_dead);
  EXPECT_EQ(run.lab["lab_control"].wait_for(60s), 4) << run.lab.log("lab_control");
  EXPECT_THAT(run.lab.still_running_after(60s), testing::IsEmpty());

  run.read();
  run.expect_victim_drives_only_its_last_plan(goes_on);
  run.expect_others_keep_clear(goes_on);
}

}  // namespace
}  // namespace hlc::test
