// The program with runs that it drives again, and with what it must refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <regex>
#include <sstream>
#include <string>

#include "hlc_bridge/record/run_folder.hpp"
#include "planner/common/text_file.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "vehicle_sim/run_folder/run_folder.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::uint64_t kNoiseSeed = 5;

/// A run of 40 steps with measurement noise, in a folder as processes write it.
class Replay : public testing::Test {
 protected:
  void SetUp() override {
    const scenario::Scenario scenario = scenario::read_scenario(
        {.file = test::source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml"});
    run_folder::write_run_folder(
        run(), scenario, kNoiseSeed,
        closed_loop::drive_experiment(scenario, {.steps = 40, .noise_seed = kNoiseSeed}));
  }

  [[nodiscard]] fs::path run() const { return folder_.path() / "one"; }
  [[nodiscard]] static test::Outcome replay(const fs::path& run, const std::string& flags) {
    return test::run_program("replay " + run.string() + " " + flags);
  }
  [[nodiscard]] test::Outcome replay(const std::string& flags) const {
    return replay(run(), flags);
  }
  void change(const std::string& file, const std::string& old, const std::string& by) const {
    const std::string text = read_file(run() / file);
    ASSERT_NE(text.find(old), std::string::npos) << file;
    write_file(run() / file, std::regex_replace(text, std::regex(old), by,
                                                std::regex_constants::format_first_only));
  }

  const test::TemporaryFolder folder_;
};

TEST_F(Replay, GivesTheSameTraceAndUntilAStepTheSameUpToThere) {
  for (const std::string flags : {"", "--until_step 17"}) {
    const auto [exit_code, output] = replay(flags);
    EXPECT_EQ(exit_code, 0) << output;
    EXPECT_THAT(output, HasSubstr("bitwise identical: trace_sha256 "));
  }
}

TEST_F(Replay, OfARecordThatWasChangedNamesStepVehicleAndWhat) {
  change("reports.csv", ",planned,", ",fallback,");
  const auto [exit_code, output] = replay("");
  EXPECT_EQ(exit_code, 1) << output;
  EXPECT_THAT(output, HasSubstr("differs (record and replay) first at step 0 (0.0 s), vehicle 1"));
  EXPECT_THAT(output, HasSubstr("fallback"));
}

TEST_F(Replay, OfAForkIsThatForkAndForksMayBeForked) {
  const auto [exit_code, output] = replay("--from_step 10 --set priorities=3,2 --set speed=1:0.5");
  ASSERT_EQ(exit_code, 0) << output;
  EXPECT_THAT(output, HasSubstr("from step 10 on: priorities=3,2, speed=1:0.5"));
  EXPECT_THAT(output, HasSubstr("parts (run and fork) at step 10 (2.0 s)"));
  const fs::path fork = folder_.path() / "one_from_10";
  EXPECT_THAT(replay(fork, "").output, HasSubstr("bitwise identical"));
  const fs::path second = folder_.path() / "second";
  const test::Outcome forked =
      replay(fork,
             "--from_step 20 --set without=2 --set obstacle=0.1,0.1,0.1,0.1,0.5 "
             "--set route=3:green --out " +
                 second.string());
  ASSERT_EQ(forked.exit_code, 0) << forked.output;
  EXPECT_THAT(forked.output, HasSubstr("at step 20 (4.0 s)"));
  EXPECT_THAT(replay(second, "").output, HasSubstr("bitwise identical"));
  EXPECT_THAT(replay(second, "--until_step 15").output, HasSubstr("bitwise identical"));
  const std::vector<result::VehicleDescription> cars =
      record::read_run_folder(second).description.vehicles;
  EXPECT_TRUE(cars.front().route);
  EXPECT_FALSE(cars.back().route) << "no longer that of the scenario";
  const test::Outcome result = test::run_program("summarize --run " + second.string());
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const test::Outcome compared =
      test::run_program("compare " + run().string() + " " + second.string());
  EXPECT_THAT(compared.output, HasSubstr("forks: null and from step 10 priorities=3,2 speed=1:0.5, "
                                         "from step 20 without=2 obstacle=0.1,0.1,0.1,0.1,0.5 "
                                         "route=3:green"));
}

TEST_F(Replay, TheTableOfTheResultIsNoWiderThanTheTerminal) {
  constexpr std::size_t kColumns = 60;
  for (const std::string& command :
       {"summarize " + run().string(),
        "replay " + run().string() + " --from_step 10 --set priorities=3"}) {
    const auto [exit_code, output] = test::run_program(command, "COLUMNS=60 ");
    EXPECT_EQ(exit_code, 0) << output;
    EXPECT_THAT(output, HasSubstr("\n id        [ms]    p99    max   error [mm] fallb.   late\n"));
    std::istringstream lines(output.substr(output.find("paper_three_cars: ")));
    for (std::string line; std::getline(lines, line);) {
      const bool is_one_word = line.find(' ', line.find_first_not_of(' ')) == std::string::npos;
      EXPECT_TRUE(line.size() <= kColumns || is_one_word ||
                  line.find(folder_.path().string()) != std::string::npos)
          << line;
    }
  }
}

TEST_F(Replay, AForkWithoutAVehicleIsAWholeRun) {
  const auto [exit_code, output] = replay("--from_step 10 --set without=2");
  ASSERT_EQ(exit_code, 0) << output;
  EXPECT_THAT(record::read_run_folder(folder_.path() / "one_from_10").incomplete,
              testing::IsEmpty());
}

TEST_F(Replay, AForkOfARunThatMayOnlyBeReadCanBeChanged) {
  const fs::path flags = run() / "configuration" / "flags.yaml";
  fs::permissions(flags, fs::perms::owner_read);
  const auto [exit_code, output] = replay("--from_step 10 --set priorities=3");
  ASSERT_EQ(exit_code, 0) << output;
  const fs::path copy = folder_.path() / "one_from_10" / "configuration" / "flags.yaml";
  EXPECT_NE(fs::status(copy).permissions() & fs::perms::owner_write, fs::perms::none);
}

// Its map is larger than the largest file that may be written: 60 blocks of 512 bytes.
TEST_F(Replay, AForkThatCannotBeWrittenLeavesNothing) {
  const fs::path others = folder_.path() / "one_from_10.part";
  write_file(others, "of somebody else");
  const auto [exit_code, output] =
      test::run_program("replay " + run().string() + " --from_step 10 --set priorities=3",
                        "trap '' XFSZ; ulimit -f 60; ");
  EXPECT_EQ(exit_code, 2) << output;
  EXPECT_THAT(output, HasSubstr("one_from_10"));
  const auto num_entries =
      std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
  EXPECT_EQ(num_entries, 2) << "the run, and what was there";
  EXPECT_TRUE(fs::exists(others));
}

TEST_F(Replay, OfARunThatEndedEarlyComparesWhatIsRecorded) {
  const std::string reports = read_file(run() / "reports.csv");
  std::ofstream(run() / "reports.csv") << reports.substr(0, reports.find("\n20,") + 1);
  const auto [exit_code, output] = replay("");
  EXPECT_EQ(exit_code, 1) << "nothing ended the run early\n" << output;
  EXPECT_THAT(output, HasSubstr("of 40 steps are recorded: reports.csv ends early"));
  change("run.json", "\"reason\": \"\"", "\"reason\": \"interrupted\"");
  EXPECT_EQ(replay("").exit_code, 0);
  const std::size_t step = reports.find("\n20,");
  std::ofstream(run() / "reports.csv") << reports.substr(0, reports.find('\n', step + 1) + 1);
  EXPECT_EQ(replay("").exit_code, 0) << "only one of three vehicles has reported the last step";
  EXPECT_EQ(replay("--from_step 30 --set speed=1:0.5").exit_code, 0);
  std::ofstream(run() / "reports.csv") << reports.substr(0, reports.find('\n') + 1);
  EXPECT_EQ(replay("").exit_code, 2) << "nothing to compare with";
}

TEST_F(Replay, OfARunWithBadFactsOrForksNamesTheFile) {
  std::ofstream(run() / "configuration" / "forks.yaml")
      << "forks:\n  - from: 3\n    set: ['foo=3']\n";
  const test::Outcome forks = replay("");
  EXPECT_EQ(forks.exit_code, 2);
  EXPECT_THAT(forks.output, HasSubstr("forks.yaml: "));
  change("run.json", "\"steps\": 40", "\"steps\": 1000000");
  const test::Outcome steps = replay("");
  EXPECT_EQ(steps.exit_code, 2);
  EXPECT_THAT(steps.output, HasSubstr("run.json: steps = 1000000, must be in 1 ... 100000"));
}

// Such a fork would not be the same as the run before its first step.
TEST_F(Replay, NoForkIsMadeOfARunThatIsNotReplayed) {
  change("reports.csv", ",planned,", ",fallback,");
  const auto [exit_code, output] = replay("--from_step 10 --set priorities=3");
  EXPECT_EQ(exit_code, 2) << output;
  EXPECT_THAT(output, HasSubstr("differs from its record from step 0 (0.0 s), vehicle 1"));
  EXPECT_FALSE(fs::exists(folder_.path() / "one_from_10"));
}

TEST_F(Replay, RefusesWhatItCannotDriveInOneLineAndLeavesNoFolder) {
  struct Bad {
    std::string flags;
    std::string named;
  };
  for (const auto& [flags, named] :
       {Bad{"--from_step 40", "must be less than the run's 40 steps"},
        Bad{"--from_step 3 --set without=9", "1, 2, 3"}, Bad{"--set without=1", "--from_step"},
        Bad{"--from_step 3 --set criteria=1:J9", "J9"},
        Bad{"--from_step 3 --until_step 2", "2 steps"},
        Bad{"--from_step 3 --set obstacle=2,2,10,10", "must be clear of vehicle 1"},
        Bad{"--from_step 3 --set route=1:blue", "a route that vehicle 1 fits there"},
        Bad{"--out /tmp/x", "--from_step"}, Bad{"--until_step 0", "--until_step"},
        Bad{"--from_step 3 --out " + run().string(), "new or empty"},
        Bad{"--from_step 3 --out /proc/no/such", "--out"}, Bad{"--speed 3", "--speed"}}) {
    const auto [exit_code, output] = replay(flags);
    EXPECT_EQ(exit_code, 2) << flags << '\n' << output;
    EXPECT_THAT(output, HasSubstr(named));
    EXPECT_EQ(std::ranges::count(output, '\n'), 1) << output;
    EXPECT_FALSE(fs::exists(folder_.path() / "one_from_3")) << flags;
  }
}

TEST(ReplayProgram, OfAFolderThatIsNoRunIsRefusedAndHelpNamesTheExitCodes) {
  const auto [exit_code, output] = test::run_program("replay --run /tmp");
  EXPECT_EQ(exit_code, 2);
  EXPECT_THAT(output, HasSubstr("no run folder"));
  EXPECT_THAT(test::run_program("replay --help").output, HasSubstr("Exit codes"));
}

TEST_F(Replay, OfARunInRealTimeNeedsItsMessagesAndForksNone) {
  change("run.json", "\"simulated_time\": true", "\"simulated_time\": false");
  const auto refusal = [this](const std::string& flags) {
    const auto [exit_code, output] = replay(flags);
    EXPECT_EQ(exit_code, 2) << output;
    EXPECT_EQ(std::ranges::count(output, '\n'), 1) << output;
    return output;
  };
  EXPECT_THAT(refusal(""), HasSubstr("run.mcap: is missing, must be there"));
  write_file(run() / "run.mcap", "no recording");
  EXPECT_THAT(refusal(""), HasSubstr("run.mcap: no MCAP file"));
  EXPECT_THAT(refusal("--from_step 3"), HasSubstr("must be a run in logical time"));
}

}  // namespace
}  // namespace hlc::apps
