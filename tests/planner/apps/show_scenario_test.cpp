// The program that checks and draws a scenario.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using testing::HasSubstr;

const std::string kScenario =
    std::string(HLC_SOURCE_DIR) + "/launch_scripts/scenarios/paper_three_cars.yaml";

TEST(ShowScenario, DrawsTheScenarioWhereAskedTo) {
  const TemporaryFolder folder;
  const std::string plot = (folder / "scenario.svg").string();
  const Outcome done = run_program("show_scenario --scenario " + kScenario + " --plot " + plot);
  EXPECT_EQ(done.exit_code, 0) << done.output;
  EXPECT_THAT(done.output, HasSubstr("green"));
  std::stringstream text;
  text << std::ifstream(plot).rdbuf();
  EXPECT_TRUE(text.str().starts_with("<svg"));
  EXPECT_THAT(text.str(), HasSubstr(">vehicle 3: green<"));
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
