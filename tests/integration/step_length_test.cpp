// Labs with other steps than 0.2 s: the paper's three cars, all processes started by run_lab.sh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/common/text_file.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

struct Lab {
  std::string name;
  std::string step_s;
  std::string horizon_steps;  ///< a plan may not outlive the command that it is sent in
};
void PrintTo(const Lab& lab, std::ostream* out) { *out << lab.name; }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

class StepLength : public testing::TestWithParam<Lab> {
 protected:
  StepLength() {
    const std::string scripts = source_folder() + "/launch_scripts/";
    write_file(folder_ / "automaton.yaml", replaced(read_file(scripts + "automata/paper.yaml"),
                                                    "step_s: 0.2", "step_s: " + GetParam().step_s));
    std::string scenario = read_file(scripts + "scenarios/paper_three_cars.yaml");
    scenario = replaced(scenario, "../automata/paper.yaml", "automaton.yaml");
    scenario = replaced(scenario, "../maps", scripts + "maps");
    scenario = replaced(scenario, "horizon_steps: 8", "horizon_steps: " + GetParam().horizon_steps);
    write_file(folder_ / "scenario.yaml", scenario);
  }

  ChildProcess run_lab(const std::vector<std::string>& further) {
    std::vector<std::string> flags{source_folder() + "/launch_scripts/run_lab.sh",
                                   "--bin",
                                   build_folder() + "/bin",
                                   "--scenario",
                                   folder_ / "scenario.yaml",
                                   "--out",
                                   folder_ / "run",
                                   "--steps",
                                   "20"};
    flags.insert(flags.end(), further.begin(), further.end());
    return ChildProcess(flags, folder_ / "output");
  }
  [[nodiscard]] std::string output() const { return read_text(folder_ / "output"); }

  void expect_driven() const {
    const auto summary = nlohmann::json::parse(read_file(folder_ / "run" / "summary.json"));
    EXPECT_EQ(summary.at("steps"), 20);
    EXPECT_EQ(std::to_string(summary.at("step_s").get<double>()).substr(0, 4),
              (GetParam().step_s + "0").substr(0, 4));
    EXPECT_EQ(summary.at("collisions"), 0);
  }

  const TemporaryFolder folder_;
};

TEST_P(StepLength, OfTheScenarioIsThatOfAllProcessesInLogicalTime) {
  ChildProcess run = run_lab({});
  ASSERT_EQ(run.wait_for(240s), 0) << output();
  expect_driven();
}

TEST_P(StepLength, OfTheScenarioIsThatOfAllProcessesInRealTime) {
  ChildProcess run = run_lab({"--simulated_time", "false"});
  ASSERT_EQ(run.wait_for(240s), 0) << output();
  expect_driven();
}

INSTANTIATE_TEST_SUITE_P(Labs, StepLength,
                         testing::Values(Lab{"TenTimesASecond", "0.1", "12"},
                                         Lab{"EveryThreeTenthsOfASecond", "0.3", "5"}),
                         [](const auto& one) { return one.param.name; });

TEST(StepLengths, ThatAreNoMultipleOfThePointsInACommandAreRefused) {
  const TemporaryFolder folder;
  const std::string scripts = source_folder() + "/launch_scripts/";
  write_file(folder / "automaton.yaml",
             replaced(read_file(scripts + "automata/paper.yaml"), "step_s: 0.2", "step_s: 0.22"));
  std::string scenario = read_file(scripts + "scenarios/paper_three_cars.yaml");
  scenario = replaced(scenario, "../automata/paper.yaml", "automaton.yaml");
  scenario = replaced(scenario, "../maps", scripts + "maps");
  write_file(folder / "scenario.yaml", scenario);
  ChildProcess run({scripts + "run_lab.sh", "--bin", build_folder() + "/bin", "--scenario",
                    folder / "scenario.yaml", "--out", folder / "run"},
                   folder / "output");
  EXPECT_EQ(run.wait_for(240s), 2);
  EXPECT_THAT(read_text(folder / "output"),
              testing::HasSubstr("step_s is 220 ms, must be a multiple of 50 ms"));
}

}  // namespace
}  // namespace hlc::test
