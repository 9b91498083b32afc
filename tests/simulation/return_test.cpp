// A process that comes back into a real-time run that is under way: its car drives on, and nobody
// is hurt. One of each is run with real processes, too (tests/integration/return_test.cpp).
#include <gtest/gtest.h>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "planner/coordination/missing.hpp"
#include "tests/integration/fault_rules.hpp"
#include "tests/integration/run_reports.hpp"
#include "tests/simulation/observed_run.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::closed_loop::return_test {
namespace {

constexpr VehicleId kVictim{2};
constexpr Nanoseconds kSecond = kNanosecondsPerSecond;
constexpr Nanoseconds kPatience = 60 * kSecond;
constexpr double kStanding_mps = coordination::MissingVehicleRules{}.standing_speed_mps;

double way_m(const result::Drive& drive, std::size_t from) {
  double way_m = 0.0;
  for (std::size_t i = from + 1; i < drive.size(); ++i) {
    way_m += (drive[i].pose.position_m() - drive[i - 1].pose.position_m()).norm();
  }
  return way_m;
}

class Return {
 public:
  Return(const scenario::Scenario& scenario, Transport transport, std::uint64_t seed)
      : run(scenario, {.seed = seed, .transport = transport}) {}

  /// Kills the process when vehicle 2 has driven for a while, waits until the car has stopped and
  /// all have noticed, restarts the process, and waits until the car has driven on.
  /// @param noticed  the controller logs it, beside the lab control
  void kill_and_start_again(const std::string& process, const std::string& noticed = "") {
    ASSERT_TRUE(run.comes_to(
        [&] {
          return run.is_between_commands() && test::planned_steps(run.reports(), kVictim) >= 20;
        },
        kPatience));
    run.kill(process);
    killed = run.now();
    ASSERT_TRUE(run.comes_to(
        [&] {
          return run.now() > killed + kSecond &&
                 std::abs(drive().back().speed_mps) <= kStanding_mps &&
                 run.has_logged(kLabControlName, process + " died") &&
                 (noticed.empty() || run.has_logged(controller_name(2), noticed));
        },
        kPatience));
    run.restart(process);
    const std::size_t again = drive().size();
    EXPECT_TRUE(run.comes_to([&] { return way_m(drive(), again) > 1.0; }, kPatience));
    driven_on = run.now();
  }

  void expect_good_end() {
    run.interrupt(kLabControlName);
    EXPECT_TRUE(run.comes_to([&] { return run.have_all_ended(); }, kPatience));
    for (const auto& [process, code] : run.exit_codes()) {
      EXPECT_EQ(code, process == kLabControlName ? kExitInterrupted : kExitGood) << process;
    }
    EXPECT_EQ(run.violations(), "");
    test::expect_nobody_was_touched(run);
  }

  /// Steps from the controller's first report after its return to the first with a new plan.
  [[nodiscard]] std::uint64_t steps_until_it_plans() const {
    std::optional<std::uint64_t> first;
    for (const ReportRecord& record : run.reports()) {
      const coordination::Report& report = record.report;
      if (report.vehicle != kVictim || report.step.value * (kSecond / 5) <= killed) continue;
      first = first.value_or(report.step.value);
      if (report.status == coordination::StepStatus::kPlanned) return report.step.value - *first;
    }
    return ~std::uint64_t{0};
  }

  ObservedRun run;
  Nanoseconds killed{};
  Nanoseconds driven_on{};  ///< when the car had driven on

 private:
  [[nodiscard]] const result::Drive& drive() const { return run.drives().at(kVictim.value); }
};

/// In the paper's setting and in the lab's.
template <class Check>
void in_both_settings(const Check& check) {
  for (const bool is_lab : {false, true}) {
    for (std::uint64_t seed = 1; seed <= test::num_seeds(3); ++seed) {
      SCOPED_TRACE((is_lab ? "lab, seed " : "paper, seed ") + std::to_string(seed));
      Return one(scenario_of(is_lab ? "lab_three_cars" : "paper_three_cars"),
                 is_lab ? Transport::kLab : Transport::kLoopback, seed);
      check(one);
    }
  }
}

TEST(Return, OfAControllerLetsItsCarDriveOnAmongOthers) {
  in_both_settings([](Return& one) {
    ASSERT_NO_FATAL_FAILURE(one.kill_and_start_again(controller_name(2)));
    one.expect_good_end();
    EXPECT_LE(one.steps_until_it_plans(), 10U);
  });
}

// Its controller keeps running without it, and answers it again.
TEST(Return, OfAMiddlewareLetsItsCarDriveOn) {
  in_both_settings([](Return& one) {
    ASSERT_NO_FATAL_FAILURE(one.kill_and_start_again(middleware_name(2), "middleware_2 lost"));
    one.expect_good_end();
    EXPECT_TRUE(one.run.has_logged(controller_name(2), "middleware_2 is back"));
  });
}

// Far from each other, so that no cars are coupled.
TEST(Return, OfAControllerStopsNobodyWhoIsNotCoupled) {
  const test::TemporaryFolder folder;
  test::put(folder / "far.yaml", "name: far\nsteps: 60\nautomaton: " + test::source_folder() +
                                     "/launch_scripts/automata/paper.yaml\n"
                                     "subgraph: B\nhorizon_steps: 8\nreference_speed_mps: 0.8\n"
                                     "max_expansions: 400000\n"
                                     "circle: {cars: 3, radius_m: 30.0, centre_x_m: 2.25, "
                                     "centre_y_m: 2.0}\n");
  const scenario::Scenario far = scenario::read_scenario({.file = folder / "far.yaml"});
  Return one(far, Transport::kLoopback, 1);
  ASSERT_NO_FATAL_FAILURE(one.kill_and_start_again(controller_name(2)));
  one.expect_good_end();
  for (const std::uint8_t other : std::vector<std::uint8_t>{1, 3}) {
    std::size_t meanwhile = 0;
    for (const result::DrivenSample& sample : one.run.drives().at(other)) {
      if (sample.t <= one.killed || sample.t >= one.driven_on) continue;
      ++meanwhile;
      EXPECT_GT(sample.speed_mps, 0.3) << "vehicle " << int{other};
    }
    EXPECT_GT(meanwhile, 0U);
  }
}

}  // namespace
}  // namespace hlc::closed_loop::return_test
