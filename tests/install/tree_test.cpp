// The tree that `cmake --install` makes: its programs run from anywhere, and its planner plans in
// another project.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/install/installed_tree.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test::tree {
namespace {

namespace fs = std::filesystem;

class InstalledTree : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome outcome =
        run_command("cmake --install " + build_folder() + " --prefix " + prefix_.string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  }

  const TemporaryFolder folder_;
  const fs::path prefix_ = folder_ / "installed";
};

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

TEST_F(InstalledTree, HasACommandForEveryProgramAndItsData) {
  EXPECT_THAT(names_in(prefix_), testing::ElementsAre("bin", "include", "lib", "share"));
  EXPECT_THAT(names_in(prefix_ / "share/hlc"),
              testing::ElementsAre("automata", "labs", "maps", "problems", "report", "scenarios",
                                   "sweeps"));
  expect_every_command(prefix_);
}

TEST_F(InstalledTree, DrivesTheFirstScenarioFromAnyFolder) { expect_it_drives(prefix_); }

TEST_F(InstalledTree, HasTheScriptsOfItsReport) {
  for (const std::string script : {"draw.sh", "report.sh"}) {
    const Outcome outcome =
        run_command((prefix_ / "lib/hlc/bin/report" / script).string() + " --version");
    EXPECT_EQ(outcome.output.find(script + " 0."), 0U) << outcome.output;
  }
}

TEST_F(InstalledTree, AnotherProjectPlansWithItsPlanner) {
  const std::string build = (folder_ / "build").string();
  const Outcome configured =
      run_command("cmake -S " + source_folder() + "/tests/install/example -B " + build +
                  " -DCMAKE_PREFIX_PATH=" + prefix_.string());
  ASSERT_EQ(configured.exit_code, 0) << configured.output;
  const Outcome compiled = run_command("cmake --build " + build);
  ASSERT_EQ(compiled.exit_code, 0) << compiled.output;
  const Outcome planned = run_command(build + "/plan_once");
  ASSERT_EQ(planned.exit_code, 0) << planned.output;
  EXPECT_EQ(std::stod(planned.output), built_cost_m2()) << planned.output;
}

TEST_F(InstalledTree, OfAnotherVersionIsNotFound) {
  const Outcome configured = run_command(
      "printf 'cmake_minimum_required(VERSION 3.25)\\nproject(other NONE)\\nfind_package(hlc 9.9 "
      "CONFIG REQUIRED)\\n' > " +
      (folder_ / "CMakeLists.txt").string() + " && cmake -S " + folder_.path().string() + " -B " +
      (folder_ / "build").string() + " -DCMAKE_PREFIX_PATH=" + prefix_.string());
  EXPECT_NE(configured.exit_code, 0);
  EXPECT_NE(configured.output.find("requested version \"9.9\""), std::string::npos)
      << configured.output;
}

}  // namespace
}  // namespace hlc::test::tree
