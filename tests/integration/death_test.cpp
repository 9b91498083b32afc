// A process that dies, or never appears: it is named, the others make a minimal-risk stop,
// nothing hangs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>

#include "tests/integration/fault_rules.hpp"
#include "tests/integration/lab_processes.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

/// The vehicle stood when the stop symbol came: so the plan stopped it, not the braking. It brakes
/// for the last SimulatedVehicle::kBrakingTicks rows, whatever the time.
void expect_stood_before_the_stop(const result::Drive& drive, const std::string& id) {
  constexpr std::size_t kBrakingTicks = 50;
  ASSERT_GT(drive.size(), kBrakingTicks) << "vehicle " << id;
  const result::DrivenSample& at_stop = drive[drive.size() - 1 - kBrakingTicks];
  EXPECT_LT(std::abs(at_stop.speed_mps), 0.05) << "vehicle " << id;
}

/// Rows of reports.csv of a minimal-risk stop. Columns: step, id, status, ...
std::size_t count_minimal_risk_rows(const std::filesystem::path& file, const std::string& id) {
  std::size_t rows = 0;
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) {
    const std::string wanted = "," + id + ",minimal_risk_stop,";
    const std::size_t first_comma = line.find(',');
    if (first_comma != std::string::npos && line.compare(first_comma, wanted.size(), wanted) == 0) {
      ++rows;
    }
  }
  return rows;
}

std::size_t count_lines(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

struct Death {
  std::string victim;
  bool simulated_time;
  int signal;
};
void PrintTo(const Death& one, std::ostream* out) {
  *out << one.victim << (one.simulated_time ? "_logical" : "_real")
       << (one.signal == SIGKILL ? "_killed" : "_stopped");
}

class ProcessDeath : public testing::TestWithParam<Death> {};

TEST_P(ProcessDeath, IsNamedAndTheOthersStand) {
  const Death& death = GetParam();
  LabProcesses lab({.steps = 400, .simulated_time = death.simulated_time});
  lab.start_all();
  // The cars drive: 10 steps of three vehicles are reported.
  ASSERT_TRUE(eventually(60s, [&] { return count_lines(lab.folder() / "reports.csv") > 30 + 15; }))
      << lab.log("lab_control");
  lab[death.victim].send(death.signal);
  const auto code = lab["lab_control"].wait_for(60s);
  ASSERT_TRUE(code) << "lab control hangs";
  EXPECT_EQ(*code, 4);
  EXPECT_NE(lab.log("lab_control")
                .find(death.victim.starts_with("vehicle") ? "vehicle_raspberry_2" : death.victim),
            std::string::npos)
      << lab.log("lab_control");
  if (death.signal == SIGSTOP) lab[death.victim].send(SIGKILL);
  EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());

  const result::Drives drives = lab.drives();
  ASSERT_EQ(drives.size(), 3U);
  for (const auto& [number, drive] : drives) {
    const std::string id = std::to_string(number);
    if (death.victim != "vehicle_" + id) expect_stood_before_the_stop(drive, id);
  }
  for (const char* survivor : {"1", "3"}) {
    EXPECT_GT(count_minimal_risk_rows(lab.folder() / "reports.csv", survivor), 0U)
        << "vehicle " << survivor;
  }
  const bool is_vehicle = death.victim == "vehicle_2";
  expect_nobody_was_touched(lab, is_vehicle ? std::set<std::uint8_t>{2} : std::set<std::uint8_t>{});
  EXPECT_GT(count_lines(lab.folder() / "reports.csv"), 30U) << "results so far are kept";
}

INSTANTIATE_TEST_SUITE_P(All, ProcessDeath,
                         testing::Values(Death{"high_level_controller_2", true, SIGKILL},
                                         Death{"middleware_2", true, SIGKILL},
                                         Death{"vehicle_2", true, SIGKILL},
                                         Death{"high_level_controller_2", false, SIGKILL},
                                         Death{"middleware_2", false, SIGKILL},
                                         Death{"vehicle_2", false, SIGKILL},
                                         Death{"high_level_controller_2", true, SIGSTOP}),
                         testing::PrintToStringParamName());

class LabControlDeath : public testing::TestWithParam<bool> {};

TEST_P(LabControlDeath, EndsEveryProcess) {
  LabProcesses lab({.steps = 400, .simulated_time = GetParam()});
  lab.start_all();
  ASSERT_TRUE(eventually(60s, [&] { return count_lines(lab.folder() / "reports.csv") > 45; }));
  lab["lab_control"].send(SIGKILL);
  EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());
  expect_nobody_was_touched(lab);
  if (GetParam()) return;  // without the lab control logical time stands still, and so do the cars
  for (const auto& [id, drive] : lab.drives()) {
    ASSERT_FALSE(drive.empty());
    EXPECT_LT(std::abs(drive.back().speed_mps), 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(All, LabControlDeath, testing::Values(true, false),
                         [](const auto& one) { return one.param ? "logical" : "real"; });

class Absence : public testing::TestWithParam<std::string> {};

TEST_P(Absence, IsNamedAfterTheStatedTime) {
  LabProcesses lab({.steps = 10, .absent = {GetParam()}, .startup_timeout_s = 4});
  lab.start_all();
  const auto code = lab["lab_control"].wait_for(60s);
  ASSERT_TRUE(code) << "lab control hangs";
  EXPECT_EQ(*code, 3);
  const std::string name = GetParam() == "vehicle_2" ? "vehicle_raspberry_2" : GetParam();
  EXPECT_NE(lab.log("lab_control").find(name), std::string::npos) << lab.log("lab_control");
  EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(All, Absence,
                         testing::Values("high_level_controller_2", "middleware_2", "vehicle_2"),
                         [](const auto& one) { return one.param; });

TEST(Interruption, OfLabControlEndsEveryProcessCleanly) {
  for (const int signal : {SIGINT, SIGTERM}) {
    LabProcesses lab({.steps = 400});
    lab.start_all();
    ASSERT_TRUE(eventually(60s, [&] { return count_lines(lab.folder() / "reports.csv") > 45; }));
    lab["lab_control"].send(signal);
    EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());
    for (const std::string& name : lab.names()) {
      EXPECT_EQ(lab[name].wait_for(0ms), name == "lab_control" ? 130 : 0) << name << lab.log(name);
    }
  }
}

TEST(Interruption, OfOneProcessEndsItCleanly) {
  LabProcesses lab({.steps = 4000});
  lab.start_all();
  ASSERT_TRUE(eventually(60s, [&] { return count_lines(lab.folder() / "reports.csv") > 45; }));
  for (const char* name : {"high_level_controller_1", "middleware_2", "vehicle_3"}) {
    lab[name].send(SIGTERM);
    EXPECT_EQ(lab[name].wait_for(60s), 0) << name << lab.log(name);
  }
}

}  // namespace
}  // namespace hlc::test
