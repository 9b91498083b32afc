// Planning problems of a CommonRoad file, driven by the processes of run_lab.sh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/common/text_file.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/commonroad_samples.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test::commonroad_test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class CommonRoadRun : public testing::Test {
 protected:
  CommonRoadRun() { std::filesystem::create_directory(folder_ / "tmp"); }

  /// Two cars whose lanes cross.
  void put_problems(double speed_mps) const {
    const auto goal = [](const Pose& at) { return rectangle_at(at, {10.0, 3.4}); };
    write_file(problem(), CommonRoadSketch()
                              .lane(1, straight({-40.0, 0.0}, {40.0, 0.0}))
                              .lane(2, straight({0.0, -40.0}, {0.0, 40.0}))
                              .problem(7, {-30.0, 0.0, 0.0}, {goal({28.0, 0.0, 0.0})}, speed_mps)
                              .problem(8, {0.0, -32.0, 1.5708}, {goal({0.0, 28.0, 1.5708})})
                              .xml());
  }
  [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& further) const {
    std::vector<std::string> command{"/usr/bin/env",
                                     "TMPDIR=" + (folder_ / "tmp").string(),
                                     source_folder() + "/launch_scripts/run_lab.sh",
                                     "--bin",
                                     build_folder() + "/bin",
                                     "--startup_timeout_s",
                                     "120",
                                     "--commonroad",
                                     problem(),
                                     "--out",
                                     folder_ / "run"};
    command.insert(command.end(), further.begin(), further.end());
    return command;
  }
  [[nodiscard]] int run_lab(const std::vector<std::string>& further = {}) const {
    ChildProcess run(command(further), folder_ / "output");
    return run.wait_for(240s).value_or(-1);
  }
  [[nodiscard]] std::string problem() const { return folder_ / "crossing.xml"; }
  [[nodiscard]] std::string output() const { return read_text(folder_ / "output"); }

  const TemporaryFolder folder_;
};

TEST_F(CommonRoadRun, SolvesTheProblemsAndKeepsWhatWasDriven) {
  put_problems(0.0);
  ASSERT_EQ(run_lab(), 0) << output();
  const auto summary = nlohmann::json::parse(read_file(folder_ / "run" / "summary.json"));
  EXPECT_EQ(summary.at("collisions"), 0);
  ASSERT_EQ(summary.at("vehicles").size(), 2U);
  for (const auto& vehicle : summary.at("vehicles")) {
    EXPECT_TRUE(vehicle.at("arrived_s").is_number()) << vehicle;
  }
  const std::filesystem::path kept = folder_ / "run" / "configuration";
  EXPECT_EQ(read_file(kept / "maps/crossing.xml"), read_file(problem()));
  EXPECT_THAT(read_file(kept / "scenarios/crossing.yaml"), HasSubstr("../maps/crossing.xml"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp")) << "temporary files are removed";
}

// The scenario had been removed before the summary was made.
TEST_F(CommonRoadRun, KeepsWhatWasDrivenUntilItWasInterrupted) {
  put_problems(0.0);
  const std::filesystem::path out = folder_ / "run";
  ChildProcess run(command({"--simulated_time", "false"}), folder_ / "output");
  ASSERT_TRUE(eventually(120s, [&] { return read_text(out / "reports.csv").size() > 1000; }))
      << output();
  run.send(SIGINT);
  EXPECT_EQ(run.wait_for(60s), 130) << output();
  EXPECT_TRUE(std::filesystem::exists(out / "summary.json")) << output();
  EXPECT_TRUE(std::filesystem::exists(out / "configuration/scenarios/crossing.yaml"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp"));
}

TEST_F(CommonRoadRun, RefusesWhatCannotBeHonouredByItsName) {
  put_problems(6.0);
  EXPECT_EQ(run_lab(), 2);
  EXPECT_THAT(output(), HasSubstr("import_commonroad: " + problem() +
                                  ": planning problem 7: velocity of the initial state is 6 m/s"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp"));
}

TEST_F(CommonRoadRun, RefusesFlagsThatDoNotFit) {
  put_problems(0.0);
  EXPECT_EQ(run_lab({"--map", problem()}), 2);
  EXPECT_THAT(output(), HasSubstr("--commonroad with --map, --routes, --cars, --seed or --policy"));
  EXPECT_EQ(run_lab({"--from_standstill", "perhaps"}), 2);
  EXPECT_THAT(output(), HasSubstr("--from_standstill = perhaps, must be one of true, false"));
}

}  // namespace
}  // namespace hlc::test::commonroad_test
