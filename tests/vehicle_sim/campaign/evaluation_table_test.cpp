#include "vehicle_sim/campaign/evaluation_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hlc {
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
  EXPECT_THAT(table, HasSubstr("| Reference error, mean [mm] | 30.0 | 40.1 | "
                               "22.0 [20.0 … 24.0] | 30.7 |"));
  EXPECT_THAT(table, HasSubstr("| Time for one lap [s] | 14.00 | 13.8 | "
                               "15.50 [15.00 … 16.00] | 15.8 |"));
}

TEST(EvaluationTable, FailedRunsAreCountedAndLeftOut) {
  RunFigures failed = run("B", 99.0, 99.0);
  failed.failure = "somebody died";
  const std::string table = evaluation_markdown({run("B", 15.0, 20.0), failed}, {});
  EXPECT_THAT(table, HasSubstr("| Starts, driven / failed | 1 / 1 |"));
  EXPECT_THAT(table, Not(HasSubstr("99.0")));
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
  EXPECT_THAT(table, HasSubstr("\npaper_three_cars,2022,B,lap_s,2,15.500000,15.000000,16.000000,"
                               "15.8\n"));
}

}  // namespace
}  // namespace hlc
