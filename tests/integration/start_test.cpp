// Where a run begins: cars that stand beside their lanes or fit none, and a controller that comes
// back into a run that is under way. What is asserted is what the vehicles drove.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>

#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "planner/coordination/missing.hpp"
#include "tests/integration/fault_rules.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/integration/run_reports.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

const std::string kScripts = test::source_folder() + "/launch_scripts/";
constexpr Nanoseconds kPeriod = 200'000'000;
constexpr double kStanding_mps = coordination::MissingVehicleRules{}.standing_speed_mps;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  ASSERT_NE(text.find(from), std::string::npos) << from;
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

double way_m(const result::Drive& drive) {
  double way_m = 0.0;
  for (std::size_t i = 1; i < drive.size(); ++i) {
    way_m += (drive[i].pose.position_m() - drive[i - 1].pose.position_m()).norm();
  }
  return way_m;
}

/// The paper's red car, started elsewhere.
class Start : public testing::Test {
 protected:
  std::string red_car(const std::string& start) {
    std::string text = read_text(kScripts + "scenarios/paper_red_alone.yaml");
    replace_all(text, "../", kScripts);
    replace_all(text, "start_m: 0.0", start);
    const std::filesystem::path file = folder_ / "red.yaml";
    put(file, text);
    return file;
  }

  TemporaryFolder folder_;
};

TEST_F(Start, ACarBesideItsLaneDrivesOntoItsReference) {
  const std::string file = red_car("start_m: 1.0, start_left_m: 0.09, start_turned_rad: 0.3");
  LabProcesses lab({.scenario = file, .steps = 40});
  lab.start_all();
  ASSERT_THAT(lab.still_running_after(60s), testing::IsEmpty());
  EXPECT_EQ(lab["lab_control"].wait_for(0ms), 0) << lab.log("lab_control");
  const result::Drive drive = record::read_drive(record::drive_file(lab.folder(), 1));
  const road::ReferencePath path = scenario::read_scenario({.file = file}).vehicles.front().path;
  const auto error_m = [&path](const result::DrivenSample& sample) {
    return path.project(sample.pose.position_m()).distance_m;
  };
  EXPECT_NEAR(error_m(drive.front()), 0.09, 0.001);
  EXPECT_GT(way_m(drive), 4.0);
  double last_error_m = 0.0;
  for (std::size_t i = drive.size() / 2; i < drive.size(); ++i) {
    last_error_m = std::max(last_error_m, error_m(drive[i]));
  }
  EXPECT_LT(last_error_m, 0.07) << "as on every lap";
  EXPECT_NE(lab.log("high_level_controller_1").find("selects route"), std::string::npos);
}

TEST_F(Start, ACarThatFitsNoRouteStandsAndItsControllerSaysHowFarItIsOff) {
  LabProcesses lab({.scenario = red_car("start_m: 1.0, start_left_m: 0.5"),
                    .steps = 10,
                    .simulated_time = false,
                    .startup_timeout_s = 12});
  lab.start_all();
  ASSERT_THAT(lab.still_running_after(60s), testing::IsEmpty());
  EXPECT_EQ(lab["lab_control"].wait_for(0ms), 3);
  EXPECT_NE(lab.log("lab_control").find("not ready: middleware_1"), std::string::npos)
      << lab.log("lab_control");
  const std::string log = lab.log("high_level_controller_1");
  EXPECT_NE(log.find("fits no route: nearest is"), std::string::npos) << log;
  EXPECT_NE(log.find("mm beyond the lanes (must be <= 150 mm)"), std::string::npos) << log;
  EXPECT_LT(way_m(record::read_drive(record::drive_file(lab.folder(), 1))), 1e-6);
}

struct Setting {
  std::string name;
  std::string scenario;
  std::string transport;
};
void PrintTo(const Setting& one, std::ostream* out) { *out << one.name; }

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

class Return : public testing::TestWithParam<Setting> {};

TEST_P(Return, OfAControllerLetsItsCarDriveOnAmongOthers) {
  constexpr VehicleId kVictim{2};
  ReturningRun run(GetParam().scenario, GetParam().transport);
  ASSERT_NO_FATAL_FAILURE(run.kill_and_start_again("high_level_controller", kVictim));
  run.expect_good_end();
  EXPECT_LE(run.steps_until_it_plans(kVictim), 2 * kNanosecondsPerSecond / kPeriod);
}

// Its controller keeps running without it, and answers it again.
TEST_P(Return, OfAMiddlewareLetsItsCarDriveOn) {
  ReturningRun run(GetParam().scenario, GetParam().transport);
  const std::string controller = "high_level_controller_2";
  ASSERT_NO_FATAL_FAILURE(
      run.kill_and_start_again("middleware", {2}, {{controller, "middleware_2 lost"}}));
  run.expect_good_end();
  EXPECT_NE(run.lab.log(controller).find("middleware_2 is back"), std::string::npos)
      << run.lab.log(controller);
}

INSTANTIATE_TEST_SUITE_P(All, Return,
                         testing::Values(Setting{"paper", "paper_three_cars", "loopback"},
                                         Setting{"lab", "lab_three_cars", "lab"}),
                         [](const auto& one) { return one.param.name; });

// Far from each other, so that no cars are coupled.
TEST(ReturnAlone, OfAControllerStopsNobodyWhoIsNotCoupled) {
  const TemporaryFolder folder;
  std::string text = read_text(kScripts + "scenarios/circle.yaml");
  replace_all(text, "../", kScripts);
  replace_all(text, "cars: 4, radius_m: 1.5", "cars: 3, radius_m: 30.0");
  const std::filesystem::path file = folder / "far.yaml";
  put(file, text);
  ReturningRun run(file, "loopback");
  ASSERT_NO_FATAL_FAILURE(run.kill_and_start_again("high_level_controller", {2}));
  run.expect_good_end();
  const result::Drives drives = run.lab.drives();
  for (const std::uint8_t other : std::vector<std::uint8_t>{1, 3}) {
    const result::Drive meanwhile =
        ReturningRun::between(drives.at(other), run.killed, run.driven_on);
    ASSERT_FALSE(meanwhile.empty());
    EXPECT_GT(std::ranges::min(meanwhile, {}, &result::DrivenSample::speed_mps).speed_mps, 0.3)
        << "vehicle " << int{other};
  }
}

}  // namespace
}  // namespace hlc::test
