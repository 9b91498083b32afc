#include "vehicle_sim/campaign/paper_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hlc::campaign::paper_distance_test {
namespace {

/// The paper's lab column of subgraph D.
RunFigures papers_run(std::size_t start = 0) {
  RunFigures run{.scenario = "paper_red_alone", .profile = "2022", .subgraph = "D", .start = start};
  run.error_mean_mm = 17.0;
  run.error_std_mm = 16.1;
  run.lap_s = 16.0;
  run.generated_max = 291.0;
  return run;
}

TEST(PaperDistance, IsNothingForThePapersOwnCells) {
  const auto distance = paper_distance({papers_run()});
  ASSERT_TRUE(distance);
  EXPECT_EQ(distance->cells.size(), 4U);
  EXPECT_EQ(distance->mean_square, 0.0);
  EXPECT_EQ(distance->factor(), 1.0);
}

TEST(PaperDistance, IsTheMeanSquareOfTheLogarithmsOfTheRatios) {
  RunFigures run = papers_run();
  run.lap_s = 16.0 * std::numbers::e;
  run.generated_max = 291.0 / std::numbers::e;
  EXPECT_NEAR(paper_distance({run})->mean_square, (1.0 + 1.0) / 4.0, 1e-12);
}

TEST(PaperDistance, ComparesTheMeanOverTheStarts) {
  RunFigures low = papers_run(0);
  RunFigures high = papers_run(1);
  low.lap_s = 15.0;
  high.lap_s = 17.0;
  EXPECT_EQ(paper_distance({low, high})->mean_square, 0.0);
}

TEST(PaperDistance, ACellThatCannotBeFilledOrIsFarOffCountsAFactorOfTen) {
  const double most = std::log(10.0) * std::log(10.0);
  RunFigures no_lap = papers_run(1);
  no_lap.lap_s.reset();
  const auto missing = paper_distance({papers_run(0), no_lap});
  EXPECT_NEAR(missing->mean_square, most / 4.0, 1e-12);
  RunFigures stuck = papers_run();
  stuck.error_mean_mm = 0.0;
  stuck.generated_max = 1e6;
  EXPECT_NEAR(paper_distance({stuck})->mean_square, 2.0 * most / 4.0, 1e-12);
  RunFigures failed = papers_run();
  failed.failure = "a process died";
  EXPECT_NEAR(paper_distance({failed})->mean_square, most, 1e-12);
}

TEST(PaperDistance, SubgraphAAloneHasErrorAndLapOfThePapersSimulationAndNoVertices) {
  RunFigures run = papers_run();
  run.subgraph = "A";
  run.error_mean_mm = 40.1;
  run.error_std_mm = 35.9;
  run.lap_s = 13.8;
  run.generated_max = 1e9;
  const auto distance = paper_distance({run});
  ASSERT_EQ(distance->cells.size(), 3U);
  EXPECT_EQ(distance->mean_square, 0.0);
}

TEST(PaperDistance, ThreeCarsHaveTheVerticesOfAStepSummed) {
  RunFigures run{.scenario = "paper_three_cars", .profile = "2022", .subgraph = "D"};
  run.error_mean_mm = 19.4;
  run.error_std_mm = 17.6;
  run.lap_s = 16.2;
  run.generated_max = 1.0;
  run.generated_sum_max = 879.0;
  EXPECT_EQ(paper_distance({run})->mean_square, 0.0);
}

TEST(PaperDistance, OtherScenariosHaveNone) {
  RunFigures run = papers_run();
  run.scenario = "circle";
  EXPECT_FALSE(paper_distance({run}));
}

}  // namespace
}  // namespace hlc::campaign::paper_distance_test
