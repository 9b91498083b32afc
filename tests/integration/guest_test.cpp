// Guests as processes: one that wanders in logical time, and one that a human drives in real time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "planner/common/text_file.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

const std::string kScripts = source_folder() + "/launch_scripts/";

class GuestProcesses : public testing::Test {
 protected:
  ChildProcess run_lab(const std::string& scenario, std::vector<std::string> further) {
    std::vector<std::string> flags{kScripts + "run_lab.sh",
                                   "--bin",
                                   build_folder() + "/bin",
                                   "--scenario",
                                   scenario,
                                   "--out",
                                   folder_ / "run",
                                   "--messages",
                                   "false"};
    flags.insert(flags.end(), further.begin(), further.end());
    return ChildProcess(flags, folder_ / "output");
  }
  [[nodiscard]] std::string output() const { return read_text(folder_ / "output"); }
  [[nodiscard]] nlohmann::json summary() const {
    return nlohmann::json::parse(read_file(folder_ / "run" / "summary.json"));
  }

  const TemporaryFolder folder_;
};

TEST_F(GuestProcesses, DriveAsWithinOneProcess) {
  constexpr int kSteps = 40;
  ChildProcess run =
      run_lab(kScripts + "scenarios/lab_guest.yaml", {"--cars", "3", "--steps", "40"});
  ASSERT_EQ(run.wait_for(240s), 0) << output();
  EXPECT_THAT(output(), testing::HasSubstr("smallest distance to a guest"));
  const scenario::Scenario scenario =
      scenario::read_scenario({.file = kScripts + "scenarios/lab_guest.yaml", .cars = 3});
  const closed_loop::Experiment experiment =
      closed_loop::drive_experiment(scenario, {.steps = kSteps});
  const auto rows = result::step_records(experiment.reports, experiment.drives, experiment.facts);
  const result::RunSummary expected = result::summarize(result::describe(scenario, std::nullopt),
                                                        experiment.facts, rows, experiment.drives);
  EXPECT_EQ(summary().at("trace_sha256"), expected.trace_sha256);
  EXPECT_EQ(summary().at("min_guest_distance_m").get<double>(),
            expected.with_guests.min_distance_m.value());
  EXPECT_EQ(summary().at("collisions"), 0);
}

TEST_F(GuestProcesses, AreDrivenByKeysInRealTime) {
  std::string text = read_file(kScripts + "scenarios/lab_guest.yaml");
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"drive: wander", "drive: by_hand"},
                                                        {"../maps", kScripts + "maps"},
                                                        {"../automata", kScripts + "automata"}}) {
    text.replace(text.find(from), from.size(), to);
  }
  text.erase(text.find("    area:"), text.find("    limits:") - text.find("    area:"));
  write_file(folder_ / "scenario.yaml", text);
  ChildProcess run = run_lab(folder_ / "scenario.yaml",
                             {"--cars", "2", "--steps", "60", "--simulated_time", "false"});
  const std::string command = " --vehicle_id 30 --dds_domain ";
  ASSERT_TRUE(eventually(60s, [&] { return output().find(command) != std::string::npos; }))
      << output();
  const std::size_t at = output().find(command) + command.size();
  const std::string domain_of_run = output().substr(at, output().find(' ', at) - at);
  const std::string keys = folder_ / "keys";
  ASSERT_EQ(mkfifo(keys.c_str(), 0600), 0);
  ChildProcess driver(
      {"/bin/sh", "-c",
       "exec " + build_folder() + "/bin/drive_by_hand --scenario " +
           (folder_ / "scenario.yaml").string() + " --vehicle_id 30 --transport loopback " +
           "--dds_domain " + domain_of_run + " < " + keys},
      folder_ / "driver");
  std::ofstream pressed(keys);
  pressed << "wwwwww" << std::flush;
  EXPECT_EQ(run.wait_for(240s), 0) << output();
  pressed << "q" << std::flush;
  EXPECT_EQ(driver.wait_for(60s), 0) << read_text(folder_ / "driver");
  const result::Drive drive = record::read_drive(folder_ / "run" / "vehicle_30.csv");
  ASSERT_FALSE(drive.empty());
  EXPECT_GT((drive.back().pose.position_m() - drive.front().pose.position_m()).norm(), 0.2);
  EXPECT_EQ(summary().at("collisions"), 0);
}

TEST_F(GuestProcesses, AreNotDrivenByHandIfTheyWander) {
  ChildProcess driver({build_folder() + "/bin/drive_by_hand", "--scenario",
                       kScripts + "scenarios/lab_guest.yaml", "--vehicle_id", "30"},
                      folder_ / "driver");
  EXPECT_EQ(driver.wait_for(60s), 2);
  EXPECT_THAT(read_text(folder_ / "driver"),
              testing::HasSubstr("--vehicle_id = 30, must be a guest of"));
}

}  // namespace
}  // namespace hlc::test
