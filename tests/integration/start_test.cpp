// Where a run begins: cars that stand beside their lanes or fit none, and a controller that comes
// back into a run that is under way. What is asserted is what the vehicles drove.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hlc_bridge/core/encounters.hpp"
#include "hlc_bridge/core/run_description.hpp"
#include "hlc_bridge/core/time_grid.hpp"
#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "planner/coordination/missing.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

const std::string kScripts = std::string(HLC_SOURCE_DIR) + "/launch_scripts/";
constexpr Nanoseconds kPeriod = 200'000'000;
constexpr double kStanding_mps = MissingVehicleRules{}.standing_speed_mps;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  ASSERT_NE(text.find(from), std::string::npos) << from;
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

std::size_t count_lines(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

double way_m(const Drive& drive) {
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
  const Drive drive = read_drive(drive_file(lab.folder(), 1));
  const ReferencePath path = read_scenario({.file = file}).vehicles.front().path;
  const auto error_m = [&path](const DrivenSample& sample) {
    return path.project(sample.pose.position_m()).distance_m;
  };
  EXPECT_NEAR(error_m(drive.front()), 0.09, 0.001);
  EXPECT_GT(way_m(drive), 4.0);
  double last_error_m = 0.0;
  for (std::size_t i = drive.size() / 2; i < drive.size(); ++i) {
    last_error_m = std::max(last_error_m, error_m(drive[i]));
  }
  EXPECT_LT(last_error_m, 0.07) << "as on every lap";
  EXPECT_NE(lab.log("high_level_controller_1").find("takes route"), std::string::npos);
}

TEST_F(Start, ACarThatFitsNoRouteStandsAndItsControllerSaysHowFarItIsOff) {
  LabProcesses lab({.scenario = red_car("start_m: 1.0, start_left_m: 0.5"),
                    .steps = 10,
                    .simulated_time = false,
                    .startup_timeout_s = 6});
  lab.start_all();
  ASSERT_THAT(lab.still_running_after(60s), testing::IsEmpty());
  EXPECT_EQ(lab["lab_control"].wait_for(0ms), 3);
  EXPECT_NE(lab.log("lab_control").find("not ready: middleware_1"), std::string::npos)
      << lab.log("lab_control");
  const std::string log = lab.log("high_level_controller_1");
  EXPECT_NE(log.find("fits no route: nearest is"), std::string::npos) << log;
  EXPECT_NE(log.find("mm beyond the lanes (allowed 150 mm)"), std::string::npos) << log;
  EXPECT_LT(way_m(read_drive(drive_file(lab.folder(), 1))), 1e-6);
}

/// A run in real time that goes on after a death.
class Return : public testing::Test {
 protected:
  static LabOptions options(const std::string& scenario, int steps) {
    return {.scenario = scenario,
            .steps = steps,
            .simulated_time = false,
            .lab_control_flags = {"--on_death=continue"}};
  }

  static void start(LabProcesses& lab) {
    lab.start_all();
    ASSERT_TRUE(eventually(60s, [&] { return count_lines(reports(lab)) > 75; }))
        << lab.log("lab_control");
  }

  /// Kills the controller, waits until its car has stopped, and starts it again.
  static void kill_and_start_again(LabProcesses& lab, std::uint8_t id, Nanoseconds& killed) {
    const std::string name = "high_level_controller_" + std::to_string(id);
    killed = last(lab, id).t;
    lab[name].send(SIGKILL);
    ASSERT_EQ(lab[name].wait_for(5s), 128 + SIGKILL);
    ASSERT_TRUE(eventually(10s, [&] {
      const DrivenSample now = last(lab, id);
      return now.t > killed + kNanosecondsPerSecond && std::abs(now.speed_mps) <= kStanding_mps;
    }));
    ASSERT_TRUE(eventually(
        10s, [&] { return lab.log("lab_control").find(name + " died") != std::string::npos; }));
    lab.start_again(name);
  }

  static void expect_good_end(LabProcesses& lab) {
    EXPECT_THAT(lab.still_running_after(90s), testing::IsEmpty());
    for (const std::string& name : lab.names()) {
      EXPECT_EQ(lab[name].wait_for(0ms), 0) << name << ": " << lab.log(name);
    }
    const auto facts = nlohmann::json::parse(read_text(lab.folder() / "run.json"));
    EXPECT_EQ(facts["exit_code"], 0);
    EXPECT_EQ(facts["died"].size(), 1U);
  }

  static void expect_no_touch(const std::string& scenario_file, const Drives& drives) {
    const RunDescription run = describe(read_scenario({.file = scenario_file}), {});
    EXPECT_EQ(encounters(run.vehicles, drives, 0, ~Nanoseconds{0}).collisions, 0U);
  }

  static std::filesystem::path reports(const LabProcesses& lab) {
    return lab.folder() / "reports.csv";
  }

  /// The newest complete row of the vehicle's own record.
  static DrivenSample last(const LabProcesses& lab, std::uint8_t id) {
    const std::filesystem::path file = drive_file(lab.folder(), id);
    std::string text = read_text(file);
    text.resize(text.rfind('\n') + 1);
    const std::filesystem::path copy = lab.folder() / "so_far.csv";
    put(copy, text);
    return read_drive(copy).back();
  }

  /// Steps from the controller's first report after its return to the first with a new plan.
  static std::uint64_t steps_until_it_plans(const LabProcesses& lab, std::uint8_t id,
                                            Nanoseconds killed) {
    std::optional<std::uint64_t> first;
    for (const ReportRecord& record : read_reports(reports(lab))) {
      const Report& report = record.report;
      if (report.vehicle.value != id || report.step.value <= killed / kPeriod + 2) continue;
      first = first.value_or(report.step.value);
      if (report.status == StepStatus::kPlanned) return report.step.value - *first;
    }
    return ~std::uint64_t{0};
  }

  static Drive after(const Drive& drive, Nanoseconds t) {
    Drive rest;
    std::ranges::copy_if(drive, std::back_inserter(rest),
                         [t](const DrivenSample& sample) { return sample.t > t; });
    return rest;
  }
};

TEST_F(Return, OfAControllerLetsItsCarDriveOnAmongOthers) {
  const std::string file = kScripts + "scenarios/paper_three_cars.yaml";
  LabProcesses lab(options("paper_three_cars", 80));
  start(lab);
  Nanoseconds killed = 0;
  kill_and_start_again(lab, 2, killed);
  expect_good_end(lab);
  const Drives drives = read_drives(lab.folder(), {1, 2, 3});
  expect_no_touch(file, drives);
  const Drive rest = after(drives.at(2), killed + 2 * kNanosecondsPerSecond);
  EXPECT_GT(way_m(rest), 1.0) << lab.log("high_level_controller_2");
  EXPECT_LE(steps_until_it_plans(lab, 2, killed), 2 * kNanosecondsPerSecond / kPeriod);
}

// Far from each other, so that nobody is coupled with anybody.
TEST_F(Return, OfAControllerStopsNobodyWhoIsNotCoupled) {
  const TemporaryFolder folder;
  std::string text = read_text(kScripts + "scenarios/circle.yaml");
  replace_all(text, "../", kScripts);
  replace_all(text, "cars: 4, radius_m: 1.5", "cars: 3, radius_m: 30.0");
  const std::filesystem::path file = folder / "far.yaml";
  put(file, text);
  LabProcesses lab(options(file, 60));
  start(lab);
  Nanoseconds killed = 0;
  kill_and_start_again(lab, 2, killed);
  expect_good_end(lab);
  const Drives drives = read_drives(lab.folder(), {1, 2, 3});
  EXPECT_GT(way_m(after(drives.at(2), killed + 2 * kNanosecondsPerSecond)), 1.0);
  const auto facts = nlohmann::json::parse(read_text(lab.folder() / "run.json"));
  const Nanoseconds end = (facts["first_step"].get<Nanoseconds>() + 60) * kPeriod;
  for (const std::uint8_t other : std::vector<std::uint8_t>{1, 3}) {
    double slowest_mps = 1.0;
    for (const DrivenSample& sample : after(drives.at(other), killed)) {
      if (sample.t < end) slowest_mps = std::min(slowest_mps, sample.speed_mps);
    }
    EXPECT_GT(slowest_mps, 0.3) << "vehicle " << static_cast<int>(other);
  }
}

}  // namespace
}  // namespace hlc::test
