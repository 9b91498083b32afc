// A process that dies, or never appears, or is interrupted: one run of each kind. What the others
// do then: tests/simulation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hlc_bridge/record/facts_file.hpp"
#include "tests/integration/fault_rules.hpp"
#include "tests/integration/lab_processes.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

std::size_t count_lines(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// The cars drive: 10 steps of three vehicles are reported.
bool are_driving(const LabProcesses& lab) {
  return eventually(60s, [&] { return count_lines(lab.folder() / "reports.csv") > 30 + 15; });
}

// The library notices: a killed process by the end of its lease, or of its connection.
TEST(ProcessDeath, IsNamedAndRecordedAndEverybodyEnds) {
  LabProcesses lab({.steps = 400});
  lab.start_all();
  ASSERT_TRUE(are_driving(lab)) << lab.log("lab_control");
  lab["middleware_2"].send(SIGKILL);
  EXPECT_EQ(lab["lab_control"].wait_for(60s), 4);
  EXPECT_NE(lab.log("lab_control").find("middleware_2 died"), std::string::npos)
      << lab.log("lab_control");
  EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());
  expect_nobody_was_touched(lab);
  EXPECT_GT(count_lines(lab.folder() / "reports.csv"), 45U) << "results so far are kept";
  const result::RunFacts facts = record::read_facts(lab.folder() / "run.json");
  EXPECT_EQ(facts.exit_code, 4);
  ASSERT_FALSE(facts.died.empty());
  EXPECT_EQ(facts.died.front().process, "middleware_2");
}

TEST(ProcessDeath, OfTheLabControlEndsEveryProcess) {
  LabProcesses lab({.steps = 400, .simulated_time = false});
  lab.start_all();
  ASSERT_TRUE(are_driving(lab)) << lab.log("lab_control");
  lab["lab_control"].send(SIGKILL);
  EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());
  expect_nobody_was_touched(lab);
  for (const auto& [id, drive] : lab.drives()) {
    ASSERT_FALSE(drive.empty());
    EXPECT_LT(std::abs(drive.back().speed_mps), 0.05);
  }
}

TEST(Absence, IsNamedAfterTheStatedTime) {
  LabProcesses lab({.steps = 10, .absent = {"middleware_2"}, .startup_timeout_s = 4});
  lab.start_all();
  EXPECT_EQ(lab["lab_control"].wait_for(60s), 3);
  EXPECT_NE(lab.log("lab_control").find("middleware_2"), std::string::npos)
      << lab.log("lab_control");
  EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());
}

TEST(Interruption, OfLabControlEndsEveryProcessCleanly) {
  for (const int signal : {SIGINT, SIGTERM}) {
    LabProcesses lab({.steps = 400});
    lab.start_all();
    ASSERT_TRUE(are_driving(lab)) << lab.log("lab_control");
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
  ASSERT_TRUE(are_driving(lab)) << lab.log("lab_control");
  for (const char* name : {"high_level_controller_1", "middleware_2", "vehicle_3"}) {
    lab[name].send(SIGTERM);
    EXPECT_EQ(lab[name].wait_for(60s), 0) << name << lab.log(name);
  }
}

}  // namespace
}  // namespace hlc::test
