// The program that compares two run folders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/common/text_file.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace fs = std::filesystem;

void replace(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = read_file(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  put(file, text.replace(at, from.size(), to));
}

/// Runs of 20 steps of paper_red_alone on subgraphs B and D, and a copy of the first one.
class Compare : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome driven = run_program(
        "evaluate --scenario paper_red_alone --subgraphs B,D --starts 1 --steps 20 --keep_runs "
        "--scenario_folder " +
        source_folder() + "/launch_scripts/scenarios --out " + (folder_ / "campaign").string());
    ASSERT_EQ(driven.exit_code, 0) << driven.output;
    fs::copy(b_, copy_, fs::copy_options::recursive);
  }

  [[nodiscard]] static Outcome compare(const fs::path& a, const fs::path& b,
                                       const std::string& flags = "") {
    return run_program("compare " + a.string() + " " + b.string() + " " + flags);
  }
  void refused(const fs::path& a, const fs::path& b, const std::string& line) const {
    const Outcome outcome = compare(a, b, "--html " + page_.string());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, StartsWith("compare: "));
    EXPECT_THAT(outcome.output, HasSubstr(line));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_FALSE(fs::exists(page_));
  }

  TemporaryFolder folder_;
  fs::path b_{folder_ / "campaign" / "runs" / "0"};
  fs::path d_{folder_ / "campaign" / "runs" / "1"};
  fs::path copy_{folder_ / "copy"};
  fs::path page_{folder_ / "comparison.html"};
};

TEST_F(Compare, EqualRunsEndWithCodeZero) {
  const Outcome outcome = compare(b_, copy_);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              HasSubstr("\nthe runs are equal: 20 steps, 1 vehicle, trace_sha256 "));
  EXPECT_THAT(outcome.output, HasSubstr("\n1 red    both "));
  EXPECT_THAT(outcome.output, Not(HasSubstr("started differently")));
}

TEST_F(Compare, NoLineIsWiderThanANarrowTerminal) {
  const std::string command = "compare " + b_.string() + " " + d_.string();
  EXPECT_NE(lines_beyond(60, run_program(command).output), "") << "it would need no cut";
  const Outcome narrow = run_program(command, "COLUMNS=60 ");
  EXPECT_EQ(narrow.exit_code, 1) << narrow.output;
  EXPECT_EQ(lines_beyond(60, narrow.output), "");
  EXPECT_THAT(narrow.output, HasSubstr("\nvehicle tracking [mm]"));
}

TEST_F(Compare, RunsOfTwoSubgraphsDifferInThePlan) {
  const Outcome outcome = compare(b_, d_);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("\nstarted differently: subgraph: B and D\n"));
  EXPECT_THAT(outcome.output, HasSubstr("the runs differ at step 0 (0.0 s), vehicle 1: plan: "));
  EXPECT_THAT(outcome.output, HasSubstr("\n1 red     first "));
  EXPECT_THAT(outcome.output, HasSubstr("\n1 red    second "));
}

TEST_F(Compare, ADifferenceOfTheInputIsFoundWhereItIs) {
  const std::string time = "\n" + std::to_string(200'000'000ULL * 12) + ",";
  replace(copy_ / "vehicle_1.csv", time, time + "1");
  const Outcome outcome = compare(b_, copy_);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, testing::ContainsRegex(
                                  "the runs differ at step [0-9]+ .*vehicle 1: input: driven x "));
}

TEST_F(Compare, WhatOnlyTheStartHasDifferentIsNamedAndDoesNotCount) {
  replace(copy_ / "configuration" / "flags.yaml", "seed: null", "seed: null\nshare: null");
  replace(copy_ / "configuration" / "scenarios" / "paper_red_alone.yaml", "\n", "\n# edited\n");
  replace(copy_ / "configuration" / "flags.yaml", "routes: null", "routes: null\nstamps: exact");
  const Outcome outcome = compare(b_, copy_);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              HasSubstr("started differently: scenario paper_red_alone.yaml: other text from line "
                        "2 on\nstarted differently: stamps: null and exact\n"));
}

TEST_F(Compare, RunsOfDifferentScenariosAreCompared) {
  const fs::path other = folder_ / "other";
  ASSERT_EQ(run_program("evaluate --scenario paper_three_cars --steps 5 --keep_runs "
                        "--scenario_folder " +
                        source_folder() + "/launch_scripts/scenarios --out " + other.string())
                .exit_code,
            0);
  const Outcome outcome = compare(b_, other / "runs" / "0", "--html " + page_.string());
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("vehicle 2: reports: this vehicle in the second run only"));
  EXPECT_THAT(read_file(page_), HasSubstr("paper_three_cars"));
}

TEST_F(Compare, RecordsThatEndEarlyAreNamed) {
  const std::string text = read_file(copy_ / "vehicle_1.csv");
  put(copy_ / "vehicle_1.csv", text.substr(0, text.size() / 2));
  const Outcome outcome = compare(b_, copy_);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr(copy_.string() + ": vehicle_1.csv ends early, at "));
  EXPECT_THAT(outcome.output, HasSubstr("input: driven pose recorded in the first run only"));
}

TEST_F(Compare, ThePageHasTheSameText) {
  const Outcome outcome = compare(b_, d_, "--html " + page_.string());
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  const std::string page = read_file(page_);
  EXPECT_THAT(page, HasSubstr("started differently: subgraph: B and D"));
  EXPECT_THAT(page, HasSubstr("the runs differ at step 0 (0.0 s), vehicle 1: plan: "));
  EXPECT_THAT(page, HasSubstr("class=\"lane\""));
  EXPECT_LT(page.size(), 100'000U);
}

TEST_F(Compare, RefusesWhatIsNoRunFolder) {
  refused(b_, folder_ / "nowhere", "nowhere: no run folder, run.json is missing");
  refused(folder_.path(), b_, ": no run folder, run.json is missing");
  put(copy_ / "reports.csv", "step,id\n");
  refused(b_, copy_, "reports.csv:1: the heading must be");
  fs::remove(copy_ / "reports.csv");
  refused(b_, copy_, "copy: no run folder, reports.csv is missing");
  fs::remove_all(copy_ / "configuration");
  refused(b_, copy_, "copy: no run folder, configuration/flags.yaml is missing");
}

TEST_F(Compare, RefusesAPageThatCannotBeWritten) {
  const Outcome outcome = compare(b_, d_, "--html " + (folder_ / "no" / "page.html").string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  for (const char* record : {"run.json", "steps.csv", "run.html"}) {
    const Outcome of_record = compare(b_, d_, "--html " + (b_ / record).string());
    EXPECT_EQ(of_record.exit_code, 2);
    EXPECT_THAT(of_record.output, HasSubstr("must end in .html, and not be the run.html of a run"));
  }
}

}  // namespace
}  // namespace hlc::test
