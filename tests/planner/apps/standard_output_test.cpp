// Output of a program that is lost on a full device is an error.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps::standard_output_test {
namespace {

const std::string kLaunch = test::source_folder() + "/launch_scripts/";
const std::string kProblem = kLaunch + "problems/parked_car.json";
const std::string kJointProblem = kLaunch + "problems/two_at_a_crossing.json";
const std::string kScenario = kLaunch + "scenarios/paper_red_alone.yaml";
const std::string kThreeCars = kLaunch + "scenarios/paper_three_cars.yaml";

struct Case {
  std::string command;
  int exit_code{};
};

TEST(StandardOutput, WhatIsPrintedOnAFullDeviceIsAFailureInOneLine) {
  const test::TemporaryFolder folder;
  const std::string errors = (folder / "errors").string();
  const std::vector<Case> cases{
      {"plan_problem " + kProblem, 2},
      {"plan_problem --json " + kProblem, 2},
      {"plan_problem --help", 2},
      {"plan_problem " + kJointProblem, 2},
      {"compare_priorities " + kThreeCars + " --strategies constant --steps 1", 3},
      {"price_of_priority " + kThreeCars + " --problems 1", 2},
      {"propose_budget " + kScenario + " --steps 3 --engine best_first --deadline_ms 1000", 2},
      {"ompl_example " + kProblem + " --seconds 0.01 --runs 1", 2},
      {"rollout --steps 2 --scenario " + kScenario, 2},
      {"show_scenario --scenario " + kScenario, 2},
      {"show_scenario --starts --scenario " + kScenario, 2},
      {"generate_map --out " + (folder / "map.xml").string(), 1},
      {"generate_map --help", 1}};
  for (const auto& [command, exit_code] : cases) {
    const test::Outcome outcome = test::run_program(command + " >/dev/full 2>" + errors +
                                                    "; code=$?; cat " + errors + "; exit $code");
    EXPECT_EQ(outcome.exit_code, exit_code) << command;
    EXPECT_EQ(outcome.output,
              command.substr(0, command.find(' ')) +
                  ": standard output: cannot be written: No space left on device\n");
  }
}

}  // namespace
}  // namespace hlc::apps::standard_output_test
