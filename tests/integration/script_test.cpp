// The launch scripts as a user meets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/support/child_process.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

const std::string kScripts = std::string(HLC_SOURCE_DIR) + "/launch_scripts/";
const std::string kBin = std::string(HLC_BINARY_DIR) + "/bin";

class Scripts : public testing::Test {
 protected:
  Scripts()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("hlc_script_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Scripts() override { std::filesystem::remove_all(folder_); }

  ChildProcess run_lab(std::vector<std::string> flags) {
    flags.insert(flags.begin(), {kScripts + "run_lab.sh", "--bin", kBin});
    return ChildProcess(flags, folder_ / "output");
  }
  [[nodiscard]] std::string output() const { return read_text(folder_ / "output"); }

  std::filesystem::path folder_;
};

TEST_F(Scripts, RunLabPrintsTheTableAndLeavesNobodyBehind) {
  ChildProcess run = run_lab({"--steps", "15", "--out", (folder_ / "run").string()});
  ASSERT_EQ(run.wait_for(120s), 0) << output();
  for (const char* word : {"red", "blue", "green", "reference", "lap", "collisions"}) {
    EXPECT_NE(output().find(word), std::string::npos) << word << " in\n" << output();
  }
  for (const char* file : {"summary.json", "steps.csv", "timing.csv", "reports.csv", "run.json"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "run" / file)) << file;
  }
  EXPECT_NE(::kill(-run.pid(), 0), 0) << "somebody of the run is still there";
}

TEST_F(Scripts, AnInterruptedRunLeavesNobodyBehind) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::filesystem::path out = folder_ / ("run" + std::to_string(signal));
    ChildProcess run = run_lab({"--steps", "5000", "--out", out.string()});
    ASSERT_TRUE(eventually(60s, [&] { return read_text(out / "reports.csv").size() > 4000; }))
        << output();
    run.send(signal);
    EXPECT_EQ(run.wait_for(30s), 130) << output();
    EXPECT_TRUE(eventually(5s, [&] { return ::kill(-run.pid(), 0) != 0; }))
        << "somebody of the run is still there";
  }
}

struct BadInput {
  std::string name;
  std::vector<std::string> flags;
  std::string named;
};

class BadInputs : public Scripts, public testing::WithParamInterface<BadInput> {};

TEST_P(BadInputs, AreRefusedWithOneLineAndCode2) {
  ChildProcess run = run_lab(GetParam().flags);
  ASSERT_EQ(run.wait_for(60s), 2) << output();
  EXPECT_NE(output().find(GetParam().named), std::string::npos) << output();
  EXPECT_EQ(std::ranges::count(output(), '\n'), 1) << output();
}

INSTANTIATE_TEST_SUITE_P(
    RunLab, BadInputs,
    testing::Values(BadInput{"UnknownFlag", {"--speed", "3"}, "--speed"},
                    BadInput{"MissingValue", {"--steps"}, "--steps"},
                    BadInput{"NoSuchScenario", {"--scenario", "nowhere"}, "nowhere"},
                    BadInput{"NoSuchMap", {"--map", "nowhere.xml"}, "nowhere.xml"},
                    BadInput{"NoSuchProfile", {"--profile", "2023"}, "2023"},
                    BadInput{"NoSuchSubgraph", {"--subgraph", "Z"}, "Z"},
                    BadInput{"StepsNotANumber", {"--steps", "many"}, "steps"},
                    BadInput{"TimeNotABoolean", {"--simulated_time", "maybe"}, "maybe"},
                    BadInput{"CarsWhereTheyHaveNames", {"--cars", "3"}, "--cars"},
                    BadInput{"TooManyCars", {"--scenario", "circle", "--cars", "99"}, "99"},
                    BadInput{"DomainTooLarge", {"--dds_domain", "233"}, "233"},
                    BadInput{"DomainNotANumber", {"--dds_domain", "x"}, "dds_domain"}),
    [](const auto& one) { return one.param.name; });

TEST_F(Scripts, AFolderWithOtherThingsInItIsNotTouched) {
  std::filesystem::create_directories(folder_ / "mine");
  std::ofstream(folder_ / "mine" / "thesis.txt") << "all of it";
  ChildProcess run = run_lab({"--out", (folder_ / "mine").string()});
  EXPECT_EQ(run.wait_for(60s), 2) << output();
  EXPECT_EQ(read_text(folder_ / "mine" / "thesis.txt"), "all of it");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "mine"), {}), 1);
}

}  // namespace
}  // namespace hlc::test
