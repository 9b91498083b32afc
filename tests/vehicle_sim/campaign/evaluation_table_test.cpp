#include "vehicle_sim/campaign/evaluation_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hlc::campaign::evaluation_table_test {
namespace {

using testing::HasSubstr;
using testing::Not;

RunFigures run(const std::string& subgraph, double lap_s, double error_mm) {
  RunFigures figures{.scenario = "paper_three_cars", .profile = "2022", .subgraph = subgraph};
  figures.lap_s = lap_s;
  figures.error_mean_mm = error_mm;
  figures.error_std_mm = 1.0;
  return figures;
}

TEST(EvaluationTable, HasMeansAndRangesOverTheStartsBesideThePapersValues) {
  const std::string table =
      evaluation_markdown({run("A", 14.0, 30.0), run("B", 15.0, 20.0), run("B", 16.0, 24.0)}, {});
  EXPECT_THAT(table, HasSubstr("## paper_three_cars, profile 2022 (the paper's simulation)"));
  EXPECT_THAT(table, HasSubstr("| | A | paper | B | paper |"));
  EXPECT_THAT(table, HasSubstr("| Reference error of planned positions, mean [mm] | 30.0 | 40.1 | "
                               "22.0 [20.0 … 24.0] | 30.7 |"));
  EXPECT_THAT(table, HasSubstr("| Time for one lap [s] | 14.00 | 13.8 | "
                               "15.50 [15.00 … 16.00] | 15.8 |"));
}

TEST(EvaluationTable, TellsErrorsOfDrivenPositionsApart) {
  RunFigures driven = run("B", 15.0, 20.0);
  driven.driven_error_mean_mm = 21.5;
  driven.driven_error_std_mm = 3.5;
  const std::string table = evaluation_markdown({driven}, {});
  EXPECT_THAT(table,
              HasSubstr("| Reference error of planned positions, mean [mm] | 20.0 | 30.7 |"));
  EXPECT_THAT(table, HasSubstr("| Reference error of driven positions, mean [mm] | 21.5 | |"));
  EXPECT_THAT(
      table, HasSubstr("| Reference error of driven positions, standard deviation [mm] | 3.5 | |"));
}

TEST(EvaluationTable, FailedRunsAreCountedAndLeftOut) {
  RunFigures failed = run("B", 99.0, 99.0);
  failed.failure = "a process died";
  failed.start = 7;
  const std::string table = evaluation_markdown({run("B", 15.0, 20.0), failed}, {});
  EXPECT_THAT(table, HasSubstr("| Starts, good / failed | 1 / 1 |"));
  EXPECT_THAT(table, Not(HasSubstr("99.0")));
  EXPECT_THAT(table, HasSubstr("\nFailed: subgraph B, start 7: a process died\n"));
}

TEST(EvaluationTable, RunsWithAStuckCarCountAndAreReported) {
  RunFigures stuck = run("B", 16.0, 24.0);
  stuck.longest_wait_s = 25.0;
  stuck.stuck_vehicles = 2;
  const std::string table = evaluation_markdown({run("B", 15.0, 20.0), stuck}, {});
  EXPECT_THAT(table, HasSubstr("| Longest wait for other cars [s] | 12.5 [0.0 … 25.0] | |"));
  EXPECT_THAT(table, HasSubstr("| Runs with a car stuck at the end [%] | 50 [0 … 100] | |"));
  EXPECT_THAT(table, HasSubstr("| Starts, good / failed | 2 / 0 |"));
}

TEST(EvaluationTable, SaysWhereTheWallTimeWent) {
  RunFigures one = run("B", 15.0, 20.0);
  one.wall_s = 0.2;
  one.wall_planning_s = 0.1;
  one.wall_coordination_s = 0.05;
  one.wall_vehicles_s = 0.02;
  const std::string table = evaluation_markdown({one}, {});
  EXPECT_THAT(table, HasSubstr("| Wall time of the whole run [ms] | 200.0 |"));
  EXPECT_THAT(table, HasSubstr("| - in planning [%] | 50.0 |"));
  EXPECT_THAT(table, HasSubstr("| - in coordination [%] | 25.0 |"));
  EXPECT_THAT(table, HasSubstr("| - in the simulated vehicles [%] | 10.0 |"));
}

TEST(EvaluationTable, SaysWhereItComesFrom) {
  const std::string table =
      evaluation_markdown({run("B", 15.0, 20.0)}, {.command = "evaluate --starts 1",
                                                   .revision = "abc",
                                                   .compiler = "GCC 12",
                                                   .processor = "Z80"});
  EXPECT_THAT(
      table,
      HasSubstr("Command: `evaluate --starts 1`\n\nProgram abc, compiled by GCC 12; Z80.\n"));
}

TEST(EvaluationTable, ALapThatWasNotDrivenShowsBesideThoseThatWere) {
  RunFigures stuck = run("B", 15.0, 3.0);
  stuck.lap_s.reset();
  const std::string table = evaluation_markdown({run("B", 15.0, 20.0), stuck}, {});
  EXPECT_THAT(table, HasSubstr("| Time for one lap [s] | 15.00 | 15.8 |"));
  EXPECT_THAT(table, HasSubstr("| Starts in which it drove a lap [%] | 50 [0 … 100] | |"));
}

TEST(EvaluationTable, OtherScenariosHaveNoColumnOfThePaper) {
  RunFigures other = run("B", 15.0, 20.0);
  other.scenario = "circle";
  other.lap_s.reset();
  const std::string table = evaluation_markdown({other}, {});
  EXPECT_THAT(table, HasSubstr("| | B |\n"));
  EXPECT_THAT(table, HasSubstr("| Time for one lap [s] | - |"));
}

TEST(EvaluationTable, AsCommaSeparatedValuesHasOneRowPerQuantity) {
  const std::string table = evaluation_csv({run("B", 15.0, 20.0), run("B", 16.0, 24.0)});
  EXPECT_THAT(table,
              HasSubstr("\npaper_three_cars,2022,B,none,lap_s,2,15.500000,15.000000,16.000000,"
                        "15.8\n"));
}

TEST(EvaluationTable, APolicyHasAColumnOfItsOwnAndNoneOfThePaper) {
  RunFigures switched = run("B", 17.0, 10.0);
  switched.policy = "zones, fast";
  RunFigures failed = switched;
  failed.failure = "a process died";
  const std::vector<RunFigures> runs{run("B", 15.0, 20.0), switched, failed};
  const std::string table = evaluation_markdown(runs, {});
  EXPECT_THAT(table, HasSubstr("| | B | paper | policy zones, fast | paper |"));
  EXPECT_THAT(table, HasSubstr("| Time for one lap [s] | 15.00 | 15.8 | 17.00 | |"));
  EXPECT_THAT(table, HasSubstr("\nFailed: policy zones, fast, start 0: a process died\n"));
  EXPECT_THAT(evaluation_csv(runs), HasSubstr("\npaper_three_cars,2022,B,\"zones, fast\",lap_s,1,"
                                              "17.000000,17.000000,17.000000,\n"));
}

}  // namespace
}  // namespace hlc::campaign::evaluation_table_test
