// compare_priorities, as it is called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/common/csv.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps::compare_priorities_test {
namespace {

using test::Outcome;
using test::run_program;
using testing::HasSubstr;

const std::string kScenarios = test::source_folder() + "/launch_scripts/scenarios/";

TEST(ComparePriorities, WritesARowForEachRun) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "rows.csv").string();
  const Outcome outcome = run_program("compare_priorities " + kScenarios +
                                      "circle.yaml --cars 3,4 --strategies random,optimal "
                                      "--steps 6 --max_levels 3 --rows " +
                                      file);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("\n| 3 | random | "));
  EXPECT_THAT(outcome.output, HasSubstr("\n| 4 | optimal | "));
  EXPECT_THAT(outcome.output, HasSubstr("at most 3 levels"));
  const CsvTable rows(
      file,
      "cars,strategy,draw,steps,step_median_ms,step_p99_ms,levels_sum,levels_max,planned,"
      "vehicle_steps,driven_m,deadlock_step,compared_steps,cost_m2,optimal_order_m2,worse_steps,"
      "joint_excess");
  ASSERT_EQ(rows.size(), 4U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows.unsigned_number(i, 0), i < 2 ? 3U : 4U);
    EXPECT_EQ(rows.text(i, 1), i % 2 == 0 ? "random" : "optimal");
    EXPECT_EQ(rows.unsigned_number(i, 3), 6U);
    EXPECT_LE(rows.unsigned_number(i, 7), 3U);
    EXPECT_EQ(rows.unsigned_number(i, 9), 6 * rows.unsigned_number(i, 0));
  }
}

TEST(ComparePriorities, LeavesOutWhatDoesNotSuitTheCoordination) {
  const Outcome outcome =
      run_program("compare_priorities " + kScenarios + "circle.yaml --profile 2022 --steps 2");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("| waiting_time | "));
  EXPECT_THAT(outcome.output, testing::Not(HasSubstr("| best_order | ")));
}

TEST(ComparePriorities, RefusesBadInputInOneLine) {
  for (const std::string& command :
       {std::string("compare_priorities /nowhere.yaml"),
        "compare_priorities " + kScenarios + "circle.yaml --strategies fastest",
        "compare_priorities " + kScenarios + "circle.yaml --strategies fca,fca",
        "compare_priorities " + kScenarios + "circle.yaml --cars 0",
        "compare_priorities " + kScenarios + "circle.yaml --cars 3,3",
        "compare_priorities " + kScenarios + "circle.yaml --cars 21",
        "compare_priorities " + kScenarios + "circle.yaml --rows /nowhere/rows.csv",
        "compare_priorities " + kScenarios + "circle.yaml --profile 2022 --strategies optimal",
        "compare_priorities " + kScenarios + "circle.yaml --profile 2022 --max_levels 2",
        "compare_priorities " + kScenarios + "circle.yaml --fast"}) {
    const Outcome outcome = run_program(command);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << command << "\n" << outcome.output;
  }
}

}  // namespace
}  // namespace hlc::apps::compare_priorities_test
