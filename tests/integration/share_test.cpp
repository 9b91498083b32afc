// One middleware and one simulator process for all cars of a machine, as run_lab.sh and vehicle.sh
// start them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/child_process.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

const std::string kScripts = test::source_folder() + "/launch_scripts/";
const std::string kBin = test::build_folder() + "/bin";
/// Ample: under a sanitizer the programs read maps and automata many times slower.
const std::string kStartup_s = "120";

class SharedProcesses : public testing::Test {
 protected:
  ChildProcess run_lab(std::vector<std::string> flags) {
    flags.insert(flags.begin(),
                 {kScripts + "run_lab.sh", "--bin", kBin, "--startup_timeout_s", kStartup_s});
    return ChildProcess(flags, folder_ / "output");
  }
  ChildProcess restart(const std::string& id, const std::string& only) {
    return ChildProcess({kScripts + "vehicle.sh", "--bin", kBin, "--vehicle_ids", id, "--only",
                         only, "--out", out().string()},
                        folder_ / only);
  }
  [[nodiscard]] std::string output() const { return read_text(folder_ / "output"); }
  [[nodiscard]] std::filesystem::path out() const { return folder_ / "run"; }
  [[nodiscard]] bool has_driven(std::size_t bytes) const {
    return eventually(60s, [&] { return read_text(out() / "reports.csv").size() > bytes; });
  }
  /// As vehicle 2's processes are listed, or 0.
  [[nodiscard]] pid_t pid_of(const std::string& process) const {
    std::ifstream pids(out() / "logs" / "vehicle_2.pids");
    std::string name;
    for (pid_t pid = 0; pids >> pid >> name;) {
      if (name == process) return pid;
    }
    return 0;
  }
  static void expect_nobody_is_left(const ChildProcess& run) {
    EXPECT_TRUE(eventually(60s, [&] { return ::kill(-run.pid(), 0) != 0; }))
        << "a process of the run is left";
  }

  const TemporaryFolder folder_;
};

TEST_F(SharedProcesses, DriveAsThoseOfEveryVehicleDo) {
  for (const std::string share : {"none", "machine"}) {
    const std::filesystem::path folder = folder_ / share;
    ChildProcess run =
        run_lab({"--steps", "40", "--noise_seed", "1", "--share", share, "--out", folder.string()});
    ASSERT_EQ(run.wait_for(240s), 0) << output();
    EXPECT_EQ(std::filesystem::exists(folder / "logs" / "middleware_1-3.log"), share == "machine");
  }
  const Outcome equal =
      run_program("compare " + (folder_ / "none").string() + " " + (folder_ / "machine").string());
  EXPECT_EQ(equal.exit_code, 0) << equal.output;
  EXPECT_NE(equal.output.find("the runs are equal: 40 steps"), std::string::npos) << equal.output;
  for (const char* record : {"vehicle_1.csv", "vehicle_2.csv", "vehicle_3.csv"}) {
    const std::string own = read_text(folder_ / "none" / record);
    EXPECT_GT(own.size(), 10'000U) << record;
    EXPECT_TRUE(own == read_text(folder_ / "machine" / record)) << record;
  }
}

TEST_F(SharedProcesses, ThatDieEndTheRunWithCode4AndEveryController) {
  for (const std::string process : {"middleware_1-3", "vehicle_1-3"}) {
    SCOPED_TRACE(process);
    std::filesystem::remove_all(out());
    ChildProcess run = run_lab({"--share", "machine", "--simulated_time", "false", "--steps",
                                "1000", "--out", out().string()});
    ASSERT_TRUE(has_driven(4000)) << output();
    const pid_t pid = pid_of(process);
    ASSERT_GT(pid, 0);
    ASSERT_EQ(::kill(pid, SIGKILL), 0);
    EXPECT_EQ(run.wait_for(240s), 4) << output();
    for (const char* id : {"1", "2", "3"}) {
      const std::string named =
          (process.starts_with("middleware") ? "middleware_" : "vehicle_raspberry_") +
          std::string(id) + " died";
      EXPECT_NE(output().find(named), std::string::npos) << named << " in\n" << output();
    }
    if (process.starts_with("middleware")) {
      const std::string log = read_text(out() / "logs" / "high_level_controller_1-3.log");
      for (const char* lost :
           {"controller_1: middleware_1 lost", "controller_3: middleware_3 lost"}) {
        EXPECT_NE(log.find(lost), std::string::npos) << log;
      }
    }
    expect_nobody_is_left(run);
  }
}

TEST_F(SharedProcesses, AControllerIsStartedAgainAloneButNothingThatOthersShare) {
  ChildProcess run = run_lab({"--share", "machine", "--simulated_time", "false", "--on_death",
                              "continue", "--steps", "100", "--out", out().string()});
  ASSERT_TRUE(has_driven(8000)) << output();
  for (const std::string only : {"middleware", "vehicle"}) {
    EXPECT_EQ(restart("2", only).wait_for(60s), 2);
    EXPECT_EQ(read_text(folder_ / only),
              "vehicle.sh: --only = " + only +
                  ": vehicle 2 shares it, must be with --vehicle_ids 1,2,3\n");
  }
  const pid_t pid = pid_of("high_level_controller_2");
  ASSERT_GT(pid, 0);
  ASSERT_EQ(::kill(pid, SIGKILL), 0);
  ASSERT_TRUE(eventually(60s, [&] {
    return output().find("high_level_controller_2 died") != std::string::npos;
  })) << output();
  ChildProcess again = restart("2", "hlc");
  // 5: on a busy machine any vehicle may leave its plan.
  const std::optional<int> code = run.wait_for(240s);
  EXPECT_TRUE(code == 0 || code == 5) << output();
  EXPECT_EQ(again.wait_for(60s), 0) << read_text(folder_ / "hlc");
  EXPECT_NE(output().find("high_level_controller_2 is back"), std::string::npos) << output();
}

TEST_F(SharedProcesses, EndWithARunThatIsInterrupted) {
  ChildProcess run = run_lab({"--share", "machine", "--steps", "5000", "--out", out().string()});
  ASSERT_TRUE(has_driven(4000)) << output();
  run.send(SIGTERM);
  EXPECT_EQ(run.wait_for(60s), 130) << output();
  expect_nobody_is_left(run);
}

TEST_F(SharedProcesses, AreRefusedWhereTheyCannotWork) {
  EXPECT_EQ(run_lab({"--share", "both"}).wait_for(60s), 2);
  EXPECT_EQ(output(), "run_lab.sh: --share = both, must be one of none, machine\n");
  EXPECT_EQ(run_lab({"--share", "machine", "--transport", "lab"}).wait_for(60s), 2);
  EXPECT_EQ(output(),
            "run_lab.sh: --share = machine with --transport = lab in logical time, must be none\n");
}

}  // namespace
}  // namespace hlc::test
