// Every program and script has --help and --version.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "planner/common/program_version.hpp"
#include "tests/house/command_help.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;

TEST(EveryProgramAndScript, SaysItsNameVersionAndRevision) {
  ASSERT_TRUE(std::regex_match(program_release(), std::regex(R"([0-9]+\.[0-9]+\.[0-9]+)")));
  for (const std::string& command : all_commands()) {
    SCOPED_TRACE(command);
    const test::Outcome outcome = test::run_program(command + " --version");
    EXPECT_EQ(outcome.exit_code, 0);
    const std::string name = fs::path(command).filename();
    const std::string begin = (name == "version.sh" ? "hlc" : name) + " " + program_release();
    EXPECT_TRUE(outcome.output.starts_with(begin + ", revision ")) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  }
}

TEST(EveryProgramAndScript, RefusesAnUnknownFlagInOneLine) {
  for (const std::string& command : all_commands()) {
    SCOPED_TRACE(command);
    const test::Outcome outcome = test::run_program(command + " --no_such_flag");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  }
}

TEST(RunTests, RefusesAFolderWithoutTestsAndNamesThoseThatHaveThem) {
  const test::Outcome outcome =
      test::run_program(fs::path(test::source_folder() + "/launch_scripts/run_tests.sh")
                            .lexically_relative(fs::path(test::build_folder()) / "bin")
                            .string() +
                        " planner/no_such_folder");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.output.find("run_tests.sh: FOLDER = planner/no_such_folder, must be one of "),
            0U);
  EXPECT_NE(outcome.output.find(" planner/search,"), std::string::npos) << outcome.output;
}

}  // namespace
}  // namespace hlc::test
