// What the launch scripts refuse before they build or start anything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

#include "planner/coordination/priorities/strategies.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A script that is called instead of another one.
void put_script(const fs::path& file, const std::string& lines) {
  fs::create_directories(file.parent_path());
  fs::remove(file);
  std::ofstream(file) << "#!/bin/sh\n" << lines << '\n';
  fs::permissions(file, fs::perms::owner_all);
}

/// A clone in which nothing is built, with a setup.sh and a build.sh that only print a word.
class FreshClone : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(launch_);
    for (const auto& one : fs::directory_iterator(source_folder() + "/launch_scripts")) {
      fs::create_symlink(one.path(), launch_ / one.path().filename());
    }
    fs::remove(launch_ / "run_lab.sh");
    fs::copy(source_folder() + "/launch_scripts/run_lab.sh", launch_ / "run_lab.sh");
    fs::create_symlink(source_folder() + "/planner", clone_ / "planner");
    put_script(launch_ / "setup.sh", "");
    put_script(launch_ / "build.sh", "echo builds; exit 1");
    put(clone_ / "file", "");
    fs::create_directories(clone_ / "full");
    put(clone_ / "full" / "file", "");
  }
  [[nodiscard]] Outcome run_lab(const std::string& flags) const {
    return run_command("cd " + clone_.string() + " && launch_scripts/run_lab.sh " + flags);
  }

  TemporaryFolder folder_;
  fs::path clone_{folder_ / "clone"};
  fs::path launch_{clone_ / "launch_scripts"};
};

struct Refused {
  std::string name;
  std::string flags;
  std::string line;  ///< a part of it
};
void PrintTo(const Refused& one, std::ostream* out) { *out << one.name; }

class BeforeItBuilds : public FreshClone, public testing::WithParamInterface<Refused> {};

TEST_P(BeforeItBuilds, AWrongValueIsRefusedInOneLine) {
  const Outcome outcome = run_lab(GetParam().flags);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("run_lab.sh: " + GetParam().line));
  EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(
    RunLab, BeforeItBuilds,
    testing::Values(
        Refused{"EmptyScenario", "--scenario ''", "--scenario = , must be a scenario file"},
        Refused{"EmptyOut", "--out=", "--out = , must be a new or an empty folder"},
        Refused{"EmptyProblems", "--dump_problems ''", "--dump_problems = , must be a new or an"},
        Refused{"EmptyEngine", "--engine ''", "--engine = , must not be empty"},
        Refused{"UnknownFlagAtTheEnd", "--foo", "unknown flag --foo (see --help)"},
        Refused{"UnknownFlagWithAValue", "--foo=3", "unknown flag --foo (see --help)"},
        Refused{"NoValue", "--cars", "--cars needs a value"},
        Refused{"ScenarioIsAFolder", "--scenario full", "--scenario = "},
        Refused{"OutIsAFile", "--out file", "--out = "},
        Refused{"OutIsFull", "--out full", "--out = "},
        Refused{"ProblemsAreFull", "--dump_problems full", "--dump_problems = "},
        Refused{"UnknownPriorities", "--priorities fastest",
                "--priorities = fastest, must be one of best_order, "},
        Refused{"CarsWhereTheyHaveNames", "--cars 3", "--cars: "},
        Refused{"MoreCarsThanTheLabHas", "--scenario circle --cars 31", "--cars = 31, must be in"},
        Refused{"SeedWhereNothingIsDrawn", "--seed 3", "--seed: "},
        Refused{"NoSuchMap", "--map nowhere.xml", "--map = "},
        Refused{"MapIsAFolder", "--map full", "--map = "},
        Refused{"OtherRoutes", "--routes straight", "--routes = straight, must be random"},
        Refused{"OtherProfile", "--profile 2021",
                "--profile = 2021, must be one of default, 2022"}),
    [](const auto& one) { return one.param.name; });

TEST_F(FreshClone, RightValuesAreBuiltFor) {
  put(clone_ / "own.yaml", "{routes: random, draw: {cars: 2}, automaton: a.yaml}");
  put(clone_ / "cones.yaml", "{routes: random, obstacles: [{name: cone, circle: {x_m: 1}}]}");
  fs::create_directories(clone_ / "reconfiguration");  // hides no shipped scenario
  for (const char* flags :
       {"", "--scenario circle --cars 3", "--scenario lab_cars --cars 30 --seed 3", "--out new",
        "--scenario own.yaml --map file --cars 2 --seed 3", "--map file --routes random --seed 3",
        "--security=", "--dump_problems new", "--scenario reconfiguration", "--profile 2022",
        "--scenario cones.yaml --map file"}) {
    EXPECT_EQ(run_lab(flags).output, "builds\n") << flags;
    EXPECT_FALSE(fs::exists(clone_ / "new")) << "made although there is no program";
  }
}

TEST_F(FreshClone, EveryPriorityStrategyIsBuiltFor) {
  for (const std::string& name : coordination::priority_strategy_names()) {
    EXPECT_EQ(run_lab("--priorities " + name).output, "builds\n") << name;
  }
}

TEST(OtherScripts, NameAnUnknownFlagAtTheEndAsUnknown) {
  for (const char* script : {"vehicle.sh", "make_security.sh", "build.sh", "run_tests.sh"}) {
    const Outcome outcome =
        run_command(source_folder() + "/launch_scripts/" + script + " --no_such_flag");
    EXPECT_EQ(outcome.exit_code, 2) << script;
    EXPECT_THAT(outcome.output, HasSubstr("unknown flag --no_such_flag"));
  }
}

/// build.sh with a cmake that only prints what the build tool of a build tree would do.
class BuildScript : public FreshClone {
 protected:
  [[nodiscard]] std::string output_with(const std::string& planned) const {
    fs::remove(launch_ / "build.sh");
    fs::copy(source_folder() + "/launch_scripts/build.sh", launch_ / "build.sh");
    put_script(folder_ / "bin" / "cmake",
               "case \"$*\" in *' -- -n') echo '" + planned + "' ;; esac");
    return run_command("PATH=" + (folder_ / "bin").string() + ":$PATH " +
                       (launch_ / "build.sh").string() + " --run_programs | cat")
        .output;
  }
};

TEST_F(BuildScript, AnnouncesABuildOnlyIfThereIsSomethingToCompile) {
  EXPECT_THAT(output_with("[1/9] Building CXX object planner/a.cpp.o"), HasSubstr("Building"));
  EXPECT_EQ(output_with("ninja: no work to do."), "");
  EXPECT_EQ(output_with("[1/1] Generating the list of tests"), "");
}

}  // namespace
}  // namespace hlc::test
