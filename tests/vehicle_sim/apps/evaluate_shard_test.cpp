// Shards of a campaign and their merged rows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planner/common/random_index.hpp"
#include "planner/common/text_file.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/vehicle_sim/apps/timeless_results.hpp"

namespace hlc::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

constexpr int kRuns = 6;

class EvaluateShards : public testing::Test {
 protected:
  [[nodiscard]] Outcome evaluate(const std::string& flags, const std::string& out) const {
    return run_program(
        "evaluate --scenario paper_red_alone --subgraphs B,D --starts 3 --steps 10 "
        "--scenario_folder " +
        source_folder() + "/launch_scripts/scenarios --out " + (folder_ / out).string() + " " +
        flags);
  }

  /// Drives the shard into a folder of its own. @return its rows
  std::string shard(std::size_t index, std::size_t count, const std::string& flags = "") const {
    const std::string name = "shard_" + std::to_string(index);
    const Outcome outcome = evaluate(
        "--shard " + std::to_string(index) + "/" + std::to_string(count) + " " + flags, name);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return (folder_ / name / "runs.jsonl").string();
  }

  [[nodiscard]] Outcome merge(const std::vector<std::string>& files) const {
    std::string command = "evaluate --out " + (folder_ / "merged").string() + " --merge";
    for (const std::string& file : files) command += " " + file;
    return run_program(command);
  }

  /// That the merge is refused with one line that names the file, if there is one, and has this
  /// text.
  void expect_refused(const std::vector<std::string>& files, const std::string& file,
                      const std::string& text) const {
    const Outcome outcome = merge(files);
    EXPECT_EQ(outcome.exit_code, 2);
    const std::string place = file.empty() ? ": " : " = " + file + ": ";
    EXPECT_THAT(outcome.output, AllOf(HasSubstr("evaluate: --merge" + place), HasSubstr(text)));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "merged"));
  }

  /// Replaces a text of the file's first line.
  static void change_heading(const std::string& file, const std::string& from,
                             const std::string& to) {
    std::string text = read_file(file);
    const std::size_t at = text.find(from);
    ASSERT_LT(at, text.find('\n')) << from;
    put(file, text.replace(at, from.size(), to));
  }

  TemporaryFolder folder_;
};

TEST_F(EvaluateShards, MergedInAnyOrderTheyAreWhatOneCallWrites) {
  ASSERT_EQ(evaluate("", "whole").exit_code, 0);
  const nlohmann::json whole = timeless(rows_of(folder_ / "whole"));
  ASSERT_EQ(whole["runs"].size(), std::size_t{kRuns});
  for (std::uint64_t seed = 1; seed <= num_costly_seeds(4); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const std::size_t count = 1 + random_index(random, kRuns + 3);
    std::vector<std::string> files;
    for (std::size_t index = 1; index <= count; ++index) files.push_back(shard(index, count));
    for (std::size_t i = files.size(); i > 1; --i) {
      std::swap(files[i - 1], files[random_index(random, i)]);
    }
    const Outcome outcome = merge(files);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("6 runs, 0 failed"));
    EXPECT_EQ(timeless(rows_of(folder_ / "merged")), whole);
    for (const char* table : {"runs.csv", "cars.csv"}) {
      EXPECT_EQ(timeless_table(folder_ / "merged" / table),
                timeless_table(folder_ / "whole" / table));
    }
    // One call for all runs finds them driven.
    EXPECT_THAT(evaluate("", "merged").output, HasSubstr("6 of 6 runs already driven"));
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      if (entry.path().filename() != "whole") std::filesystem::remove_all(entry.path());
    }
  }
}

TEST_F(EvaluateShards, AShardHasEveryNthRunAndNothingElse) {
  const std::string rows = read_file(shard(2, 4));
  EXPECT_EQ(std::ranges::count(rows, '\n'), 3);
  EXPECT_THAT(rows, AllOf(HasSubstr("\n{\"run\":1,"), HasSubstr("\n{\"run\":5,")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "shard_2/runs.csv"));
}

TEST_F(EvaluateShards, RowsThatDoNotBelongTogetherAreRefusedInOneLine) {
  const std::string first = shard(1, 2);
  const std::string second = shard(2, 2, "--jobs 1");  // the last row is that of run 5
  const std::string good = read_file(second);
  expect_refused({first}, "", "run 1, 3, 5 in none of the 1 files, must be all runs 0 ... 5");
  expect_refused({first, second, first}, first, "run 0 is in " + first + ", too, must be in one");
  expect_refused({first, second + "x"}, second + "x", "is no file, must be");
  change_heading(second, "\"format\":1", "\"format\":0");
  expect_refused({first, second}, second, "rows of format 0, must be 1");
  put(second, good);
  change_heading(second, "\"format\":1,", "");
  expect_refused({first, second}, second, "rows of format none, must be 1");
  put(second, good);
  change_heading(second, "\"seed\":1", "\"seed\":2");
  expect_refused({first, second}, second, "another campaign (seed 2), must be that of " + first);
  put(second, good.substr(0, good.size() - 40));
  expect_refused({first, second}, "", "run 5 in none of the 2 files");
  put(second, good + "text\n");
  expect_refused({first, second}, second, "line 5 of runs.jsonl is no record of a run");
  for (const auto& [was, is] :
       {std::pair{"\"run\":5", "\"run\":7"}, {"\"start\":", "\"start\":1"}}) {
    std::string changed = good;
    changed.replace(changed.rfind(was), std::string(was).size(), is);
    put(second, changed);
    expect_refused({first, second}, second, "line 4 of runs.jsonl is no record of a run, or was");
  }
  put(second, "text\n");
  expect_refused({first, second}, second, "the first line is not that of a campaign");
}

TEST_F(EvaluateShards, RowsOfAnotherProgramAreRefused) {
  const std::string first = shard(1, 2);
  const std::string second = shard(2, 2);
  change_heading(second, "\"program\":\"", "\"program\":\"0");
  expect_refused({first, second}, second, "another campaign (program), must be that of");
}

TEST_F(EvaluateShards, MergedRowsNeedANewFolder) {
  const std::string all = shard(1, 1);
  ASSERT_EQ(merge({all}).exit_code, 0);
  const Outcome again = merge({all});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.output, HasSubstr("has rows already, must be a new folder"));
}

TEST_F(EvaluateShards, FlagsOutOfBoundsAreRefused) {
  for (const char* shard : {"0/3", "4/3", "3", "1/0", "a/3", "1/3/5", "1/100001", "-1/3"}) {
    const Outcome outcome = evaluate(std::string("--shard ") + shard, "out");
    EXPECT_EQ(outcome.exit_code, 2) << shard;
    EXPECT_THAT(outcome.output, HasSubstr("must be I/N, 1 <= I <= N <= 100000")) << shard;
  }
  EXPECT_THAT(evaluate("--shard 1/2 --series", "out").output, EndsWith("excludes --shard\n"));
  EXPECT_THAT(evaluate("--shard 1/2 --report", "out").output, HasSubstr("excludes"));
  EXPECT_THAT(evaluate("--merge rows.jsonl", "out").output, HasSubstr("excludes"));
}

}  // namespace
}  // namespace hlc::test
