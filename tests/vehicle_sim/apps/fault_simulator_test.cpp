// The program with flags that it must refuse, and with a few runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>

#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps {
namespace {

test::Outcome run_simulator(const std::string& flags) {
  return test::run_program("fault_simulator --scenario_folder " + test::source_folder() +
                           "/launch_scripts/scenarios " + flags);
}

struct BadFaultFlags {
  std::string flags;
  std::string named;  ///< what the message must speak of
};
void PrintTo(const BadFaultFlags& one, std::ostream* out) { *out << '"' << one.flags << '"'; }

class FaultSimulatorRefuses : public testing::TestWithParam<BadFaultFlags> {};

TEST_P(FaultSimulatorRefuses, InOneLineWithExitCodeTwo) {
  const auto [exit_code, output] = run_simulator(GetParam().flags);
  EXPECT_EQ(exit_code, 2) << output;
  EXPECT_NE(output.find(GetParam().named), std::string::npos) << output;
  EXPECT_EQ(std::ranges::count(output, '\n'), 1) << output;
}

INSTANTIATE_TEST_SUITE_P(
    Flags, FaultSimulatorRefuses,
    testing::Values(BadFaultFlags{"--cars 2", "--cars"}, BadFaultFlags{"--cars 9", "3 ... 8"},
                    BadFaultFlags{"--cars 21 --scenario lab_cars", "3 ... 20"},
                    BadFaultFlags{"--cars -1", "--cars"}, BadFaultFlags{"--runs 0", "--runs"},
                    BadFaultFlags{"--seed -1", "--seed"},
                    BadFaultFlags{"--faults kill,flood", "flood"},
                    BadFaultFlags{"--faults kill,kill", "twice"},
                    BadFaultFlags{"--jobs 0", "--jobs"}, BadFaultFlags{"--speed 3", "--speed"},
                    BadFaultFlags{"--runs 1 --out /dev/null/records", "--out"},
                    BadFaultFlags{"--keep 1", "--replay"},
                    BadFaultFlags{"--trace x.txt", "--replay"},
                    BadFaultFlags{"--cars 3 --replay 1 --keep 1,two", "two"},
                    BadFaultFlags{"--cars 3 --replay 1 --keep 99", "99"},
                    BadFaultFlags{"--cars 3 --replay 1 --trace /no/such/folder/x", "--trace"}));

TEST(FaultSimulator, HelpIsGoodAndNamesTheExitCodes) {
  const auto [exit_code, output] = run_simulator("--help");
  EXPECT_EQ(exit_code, 0);
  EXPECT_NE(output.find("Exit codes"), std::string::npos);
}

TEST(FaultSimulator, KeepsTheRecordsOfItsRuns) {
  const test::TemporaryFolder folder;
  const auto [exit_code, output] =
      run_simulator("--cars 3 --runs 2 --seed 4 --out " + folder.path().string());
  EXPECT_EQ(exit_code, 0) << output;
  for (const char* seed : {"4", "5"}) {
    for (const char* file :
         {"run.json", "reports.csv", "certificates.csv", "vehicle_1.csv", "vehicle_3.csv"}) {
      EXPECT_TRUE(std::filesystem::exists(folder.path() / seed / file)) << seed << ' ' << file;
    }
  }
}

TEST(FaultSimulator, FindsItsScenariosFromAnyFolder) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path("/");
  const test::Outcome outcome = test::run_program("fault_simulator --cars 3 --runs 1 --seed 1");
  std::filesystem::current_path(before);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

TEST(FaultSimulator, NamesAScenarioThatIsMissing) {
  const test::TemporaryFolder folder;
  const auto [exit_code, output] = test::run_program(
      "fault_simulator --cars 3 --runs 1 --scenario_folder " + folder.path().string());
  EXPECT_EQ(exit_code, 2) << output;
  EXPECT_NE(output.find((folder / "paper_three_cars.yaml").string()), std::string::npos) << output;
  EXPECT_EQ(std::ranges::count(output, '\n'), 1) << output;
}

TEST(FaultSimulator, SaysWhatManyRunsCameTo) {
  const auto [exit_code, output] = run_simulator("--cars 3 --runs 4 --seed 1 --jobs 2");
  EXPECT_EQ(exit_code, 0) << output;
  EXPECT_NE(output.find("4 runs, 0 failed"), std::string::npos) << output;
}

TEST(FaultSimulator, AReplayPrintsItsFaultsAndWritesATrace) {
  const test::TemporaryFolder folder;
  const std::string trace = (folder.path() / "trace.txt").string();
  const auto [exit_code, output] = run_simulator("--cars 3 --replay 4 --trace " + trace);
  EXPECT_EQ(exit_code, 0) << output;
  EXPECT_NE(output.find("repeat middleware_3 -> any"), std::string::npos) << output;
  EXPECT_GT(std::filesystem::file_size(trace), 1000U);
  EXPECT_EQ(run_simulator("--cars 3 --replay 4").output, output);
}

}  // namespace
}  // namespace hlc::apps
