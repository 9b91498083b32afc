// A controller or a middleware that comes back into a run that is under way: one run of each. What
// is asserted is what the vehicles drove. More of it: tests/simulation/return_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "planner/coordination/missing.hpp"
#include "tests/integration/fault_rules.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/integration/run_reports.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr double kStanding_mps = coordination::MissingVehicleRules{}.standing_speed_mps;

double way_m(const result::Drive& drive) {
  double way_m = 0.0;
  for (std::size_t i = 1; i < drive.size(); ++i) {
    way_m += (drive[i].pose.position_m() - drive[i - 1].pose.position_m()).norm();
  }
  return way_m;
}

/// A run in real time that goes on after a death, until it is interrupted.
class ReturningRun {
 public:
  ReturningRun(const std::string& scenario, const std::string& transport)
      : lab({.scenario = scenario,
             .steps = 1000,
             .simulated_time = false,
             .lab_control_flags = {"--on_death=continue"},
             .transport = transport}) {
    lab.start_all();
  }

  /// Kills the vehicle's process of that name when the car has driven for a while, waits until the
  /// car has stopped and all have noticed, restarts the process, and waits until the car
  /// has driven on.
  /// @param noticed  lines in processes' logs by which these have noticed, beside lab control's
  void kill_and_start_again(const std::string& process, VehicleId id,
                            std::map<std::string, std::string> noticed = {}) {
    const std::string name = process + "_" + std::to_string(id.value);
    ASSERT_TRUE(eventually(kPatience, [&] { return planned_steps(lab.reports(), id) >= 20; }))
        << lab.log("lab_control");
    lab[name].send(SIGKILL);
    ASSERT_EQ(lab[name].wait_for(kPatience), 128 + SIGKILL);
    killed = time::real_time_now();
    ASSERT_TRUE(eventually(kPatience, [&] {
      const result::DrivenSample now = lab.drives().at(id.value).back();
      return now.t > killed + kNanosecondsPerSecond && std::abs(now.speed_mps) <= kStanding_mps;
    }));
    noticed["lab_control"] = name + " died";
    for (const auto& [process_name, line] : noticed) {
      ASSERT_TRUE(eventually(kPatience,
                             [&] { return lab.log(process_name).find(line) != std::string::npos; }))
          << process_name << ": " << lab.log(process_name);
    }
    lab.start(name);
    const Nanoseconds again = time::real_time_now();
    EXPECT_TRUE(eventually(kPatience, [&] {
      return way_m(between(lab.drives().at(id.value), again, kForever)) > 1.0;
    })) << lab.log(name);
    driven_on = time::real_time_now();
  }

  void expect_good_end() {
    lab["lab_control"].send(SIGINT);
    EXPECT_THAT(lab.still_running_after(kPatience), testing::IsEmpty());
    for (const std::string& name : lab.names()) {
      EXPECT_EQ(lab[name].wait_for(0ms), name == "lab_control" ? 130 : 0)
          << name << ": " << lab.log(name);
    }
    const auto facts = nlohmann::json::parse(read_text(lab.folder() / "run.json"));
    EXPECT_EQ(facts["died"].size(), 1U);
    expect_nobody_was_touched(lab);
  }

  /// Steps from the controller's first report after its return to the first with a new plan.
  [[nodiscard]] std::uint64_t steps_until_it_plans(VehicleId id) const {
    std::optional<std::uint64_t> first;
    for (const ReportRecord& record : lab.reports()) {
      const coordination::Report& report = record.report;
      if (report.vehicle != id || report.step.value * kPeriod <= killed) continue;
      first = first.value_or(report.step.value);
      if (report.status == coordination::StepStatus::kPlanned) return report.step.value - *first;
    }
    return ~std::uint64_t{0};
  }

  static result::Drive between(const result::Drive& drive, Nanoseconds from, Nanoseconds to) {
    result::Drive part;
    std::ranges::copy_if(drive, std::back_inserter(part), [&](const result::DrivenSample& sample) {
      return sample.t > from && sample.t < to;
    });
    return part;
  }

  LabProcesses lab;
  Nanoseconds killed{};
  Nanoseconds driven_on{};  ///< when the car had driven on

 private:
  static constexpr auto kPatience = 60s;
};

// As in the lab: its transport, automaton and commands.
TEST(Return, OfAControllerLetsItsCarDriveOnAmongOthers) {
  constexpr VehicleId kVictim{2};
  ReturningRun run("lab_three_cars", "lab");
  ASSERT_NO_FATAL_FAILURE(run.kill_and_start_again("high_level_controller", kVictim));
  run.expect_good_end();
  EXPECT_LE(run.steps_until_it_plans(kVictim), 2 * kNanosecondsPerSecond / kPeriod);
}

// Its controller keeps running without it, and answers it again.
TEST(Return, OfAMiddlewareLetsItsCarDriveOn) {
  ReturningRun run("paper_three_cars", "loopback");
  const std::string controller = "high_level_controller_2";
  ASSERT_NO_FATAL_FAILURE(
      run.kill_and_start_again("middleware", {2}, {{controller, "middleware_2 lost"}}));
  run.expect_good_end();
  EXPECT_NE(run.lab.log(controller).find("middleware_2 is back"), std::string::npos)
      << run.lab.log(controller);
}

}  // namespace
}  // namespace hlc::test
