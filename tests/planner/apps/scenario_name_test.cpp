#include "planner/apps/scenario_name.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;

TEST(ScenarioName, IsAFileOrTheNameOfOneInTheFolder) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(scenario_named("circle", folder.path()), folder / "circle.yaml");
  EXPECT_EQ(scenario_named("mine/circle.yaml", folder.path()), "mine/circle.yaml");
  const fs::path file = folder / "bare";
  test::run_command("touch " + file.string());
  EXPECT_EQ(scenario_named(file.string(), folder.path()), file);
  EXPECT_EQ(scenario_named("", folder.path()), "");
}

// Every program that takes a scenario, called from a folder that holds none.
TEST(ScenarioName, IsKnownToEveryProgramFromAnyFolder) {
  for (const std::string command :
       {"rollout --steps 2 --scenario ", "show_scenario --scenario ",
        "price_of_priority --problems 1 ", "propose_budget --steps 2 --deadline_ms 100 ",
        "compare_priorities --steps 2 --priorities constant "}) {
    const std::string place = "cd / && ";
    EXPECT_EQ(test::run_program(command + "paper_three_cars", place).exit_code, 0) << command;
    const test::Outcome unknown = test::run_program(command + "no_such", place);
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.output, testing::HasSubstr("no_such, must be a file, or one of circle, "));
  }
}

}  // namespace
}  // namespace hlc::apps
