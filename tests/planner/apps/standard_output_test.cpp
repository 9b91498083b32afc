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

TEST(StandardOutput, WhatIsPrintedOnAFullDeviceIsAnOutputThatCannotBeWritten) {
  const test::TemporaryFolder folder;
  const std::string errors = (folder / "errors").string();
  const std::vector<std::string> commands{
      "plan_problem " + kProblem,
      "plan_problem --json " + kProblem,
      "plan_problem --help",
      "plan_problem " + kJointProblem,
      "compare_priorities " + kThreeCars + " --priorities constant --steps 1",
      "price_of_priority " + kThreeCars + " --problems 1",
      "propose_budget " + kScenario + " --steps 3 --engine best_first --deadline_ms 1000",
      "ompl_example " + kProblem + " --time_s 0.01 --runs 1",
      "rollout --steps 2 --scenario " + kScenario,
      "show_scenario --scenario " + kScenario,
      "show_scenario --print_starts --scenario " + kScenario,
      "generate_map --out " + (folder / "map.xml").string(),
      "generate_map --help"};
  for (const std::string& command : commands) {
    const test::Outcome outcome = test::run_program(command + " >/dev/full 2>" + errors +
                                                    "; code=$?; cat " + errors + "; exit $code");
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_EQ(outcome.output,
              command.substr(0, command.find(' ')) +
                  ": standard output: cannot be written: No space left on device\n");
  }
}

}  // namespace
}  // namespace hlc::apps::standard_output_test
