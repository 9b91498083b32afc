// Every program and script has --help and --version.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "planner/common/program_version.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;

/// Programs by their names, scripts that are run (others are parts of these) by their paths from
/// the folder of the programs.
std::vector<std::string> commands() {
  std::vector<std::string> all;
  std::istringstream programs(HLC_PROGRAMS);
  for (std::string name; programs >> name;) all.push_back(name);
  const fs::path bin = fs::path(test::build_folder()) / "bin";
  const fs::path root = test::source_folder();
  for (const auto& entry : fs::directory_iterator(root / "launch_scripts")) {
    const bool is_program =
        (entry.status().permissions() & fs::perms::owner_exec) != fs::perms::none;
    if (is_program && entry.path().extension() == ".sh")
      all.push_back(entry.path().lexically_relative(bin));
  }
  all.push_back((root / "tests/verify/verify.sh").lexically_relative(bin));
  return all;
}

TEST(EveryProgramAndScript, SaysItsNameVersionAndRevision) {
  ASSERT_TRUE(std::regex_match(program_release(), std::regex(R"([0-9]+\.[0-9]+\.[0-9]+)")));
  for (const std::string& command : commands()) {
    SCOPED_TRACE(command);
    const test::Outcome outcome = test::run_program(command + " --version");
    EXPECT_EQ(outcome.exit_code, 0);
    const std::string name = fs::path(command).filename();
    const std::string begin = (name == "version.sh" ? "hlc" : name) + " " + program_release();
    EXPECT_TRUE(outcome.output.starts_with(begin + ", revision ")) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  }
}

TEST(EveryProgramAndScript, HasAHelp) {
  for (const std::string& command : commands()) {
    SCOPED_TRACE(command);
    const test::Outcome outcome = test::run_program(command + " --help");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(std::regex_search(outcome.output, std::regex("[Uu]sage:"))) << outcome.output;
  }
}

TEST(EveryProgramAndScript, RefusesAnUnknownFlagInOneLine) {
  for (const std::string& command : commands()) {
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
