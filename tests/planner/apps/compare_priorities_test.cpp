// compare_priorities, as it is called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "planner/common/csv.hpp"
#include "planner/common/text_file.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps::compare_priorities_test {
namespace {

using test::Outcome;
using test::run_program;
using testing::HasSubstr;

const std::string kScenarios = test::source_folder() + "/launch_scripts/scenarios/";

TEST(ComparePriorities, WritesARowForEachRunStepAndGap) {
  const test::TemporaryFolder folder;
  const std::filesystem::path out = folder / "new" / "priorities";
  const Outcome outcome = run_program("compare_priorities " + kScenarios +
                                      "circle.yaml --cars 3,4 --priorities random,optimal "
                                      "--steps 6 --max_levels 3 --out " +
                                      out.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("\n| 3 | random | "));
  EXPECT_THAT(outcome.output, HasSubstr("\n| 4 | optimal | "));
  EXPECT_THAT(outcome.output, HasSubstr("at most 3 levels"));
  const CsvTable runs(out / "runs.csv",
                      "run,cars,strategy,draw,steps,planned,vehicle_steps,driven_m,deadlock_step,"
                      "compared_steps,cost_m2,optimal_order_m2,worse_steps");
  ASSERT_EQ(runs.size(), 4U);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(runs.unsigned_number(i, 0), i);
    EXPECT_EQ(runs.unsigned_number(i, 1), i < 2 ? 3U : 4U);
    EXPECT_EQ(runs.text(i, 2), i % 2 == 0 ? "random" : "optimal");
    EXPECT_EQ(runs.unsigned_number(i, 4), 6U);
    EXPECT_EQ(runs.unsigned_number(i, 6), 6 * runs.unsigned_number(i, 1));
  }
  const CsvTable steps(out / "steps.csv", "run,step,step_ms,levels");
  ASSERT_EQ(steps.size(), 24U);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps.unsigned_number(i, 0), i / 6);
    EXPECT_EQ(steps.unsigned_number(i, 1), i % 6);
    EXPECT_LE(steps.unsigned_number(i, 3), 3U);
  }
  const CsvTable gaps(out / "gaps.csv", "run,vehicles,cost_m2,bound_m2");
  ASSERT_GT(gaps.size(), 0U);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    EXPECT_LE(gaps.unsigned_number(i, 1), gaps.unsigned_number(i, 0) < 2 ? 3U : 4U);
    EXPECT_GE(gaps.number(i, 2), gaps.number(i, 3) - 1e-9);
  }
  const auto campaign = nlohmann::json::parse(read_file(out / "campaign.json"));
  EXPECT_EQ(campaign.at("kind"), "priorities");
  EXPECT_THAT(campaign.at("origin").at("command").get<std::string>(),
              HasSubstr("compare_priorities " + kScenarios + "circle.yaml"));
  EXPECT_EQ(campaign.at("priorities").at("cars"), (std::vector{3, 4}));
  EXPECT_EQ(campaign.at("priorities").at("runs"), 4);
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
        "compare_priorities " + kScenarios + "circle.yaml --priorities fastest",
        "compare_priorities " + kScenarios + "circle.yaml --priorities fca,fca",
        "compare_priorities " + kScenarios + "circle.yaml --cars 0",
        "compare_priorities " + kScenarios + "circle.yaml --cars 3,3",
        "compare_priorities " + kScenarios + "circle.yaml --cars 21",
        "compare_priorities " + kScenarios + "circle.yaml --out /proc/rows",
        "compare_priorities " + kScenarios + "circle.yaml --report",
        "compare_priorities " + kScenarios + "circle.yaml --profile 2022 --priorities optimal",
        "compare_priorities " + kScenarios + "circle.yaml --profile 2022 --max_levels 2",
        "compare_priorities " + kScenarios + "circle.yaml --fast"}) {
    const Outcome outcome = run_program(command);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << command << "\n" << outcome.output;
  }
}

}  // namespace
}  // namespace hlc::apps::compare_priorities_test
