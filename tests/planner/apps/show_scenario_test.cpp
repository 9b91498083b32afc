// The program that checks and draws a scenario.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "tests/planner/apps/deployed_program.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using testing::HasSubstr;

const std::string kScenario =
    test::source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml";

TEST(ShowScenario, DrawsTheScenarioWhereAskedTo) {
  const DeployedProgram program("show_scenario");
  const Outcome done = program.run("--scenario " + kScenario);
  EXPECT_EQ(done.exit_code, 0) << done.output;
  EXPECT_THAT(done.output, HasSubstr("green"));
  EXPECT_EQ(program.kind(), "scenario");
  EXPECT_EQ(program.drawn()["vehicles"][2]["name"], "green");
  EXPECT_EQ(program.run("--scenario " + kScenario + " --print_starts").exit_code, 0);
  EXPECT_EQ(program.kind(), "sheet");
}

TEST(ShowScenario, NamesReferenceSpeedsOfVehiclesAndSections) {
  const Outcome done = run_program("show_scenario --scenario " + test::source_folder() +
                                   "/launch_scripts/scenarios/speeds.yaml");
  EXPECT_EQ(done.exit_code, 0) << done.output;
  EXPECT_THAT(done.output, HasSubstr("speed      red, 0.6 m/s\n"));
  EXPECT_THAT(done.output, testing::ContainsRegex("section    blue, [0-9.]+ ... [0-9.]+ m, 0.4"));
}

TEST(ShowScenario, DoesNotDrawOverAFileThatTheScenarioNames) {
  const TemporaryFolder folder;
  const std::string shipped = test::source_folder() + "/launch_scripts";
  const std::string lab = (folder / "lab.yaml").string();
  std::filesystem::copy_file(shipped + "/labs/cpm_lab.yaml", lab);
  const std::string scenario = (folder / "own.yaml").string();
  put(scenario, "name: own\nsteps: 10\nautomaton: " + shipped +
                    "/automata/lab.yaml\nlab: lab.yaml\nsubgraph: B\ncircle: {cars: 2, "
                    "radius_m: 1.5, centre_x_m: 2.25, centre_y_m: 2.0}\n");
  EXPECT_THAT(run_program("show_scenario --scenario " + scenario).output,
              HasSubstr("lab        " + lab));
  const Outcome refused = run_program("show_scenario --scenario " + scenario + " --plot " + lab);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("--plot = "));
}

TEST(ShowScenario, DoesNotDrawOverItsInput) {
  const TemporaryFolder folder;
  const std::string scenario = (folder / "own.yaml").string();
  put(scenario, "name: own\n");
  const Outcome refused =
      run_program("show_scenario --scenario " + scenario + " --plot " + scenario);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("--plot = "));
  std::stringstream text;
  text << std::ifstream(scenario).rdbuf();
  EXPECT_EQ(text.str(), "name: own\n");
}

}  // namespace
}  // namespace hlc::test
