#include "vehicle_sim/campaign/tradeoff.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hlc::campaign::tradeoff_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A run with a lap. @param clear_share  in zones
RunFigures run(const std::string& subgraph, const std::string& policy, double lap_s,
               double effort_per_m, std::optional<double> clear_share = {}) {
  RunFigures figures{.scenario = "s", .profile = "default", .subgraph = subgraph, .policy = policy};
  figures.lap_s = lap_s;
  figures.error_mean_mm = 1.0;
  figures.driven_error_mean_mm = 20.0;
  figures.effort_per_m = effort_per_m;
  figures.comfort_per_m = 2.0 * effort_per_m;
  figures.generated_max = 400.0;
  if (clear_share) {
    figures.above_limit_share = 0.25;
    figures.clearly_above_limit_share = clear_share;
    figures.above_limit_max_mps = 0.3;
  }
  return figures;
}

TEST(Tradeoff, HasARowPerFixedSubgraphAndPolicyWithMediansOverTheStartsWithALap) {
  RunFigures stuck = run("A", "none", 0.0, 100.0);
  stuck.lap_s.reset();
  RunFigures failed = run("A", "none", 1.0, 100.0);
  failed.failure = "a process died";
  const std::string table =
      tradeoff_markdown({run("A", "none", 15.0, 3.0), stuck, failed, run("A", "none", 16.0, 1.0),
                         run("A", "none", 20.0, 2.0), run("A", "zone", 17.0, 1.0)});
  EXPECT_THAT(table, HasSubstr("| A | 16.00 | 20.0 | 2.000 | 4.000 | 400 | 0.000 | 0.000 | - | - | "
                               "- | 0 | 3 | 4 / 5 |\n"));
  EXPECT_THAT(table, HasSubstr("| policy zone | 17.00 |"));
  EXPECT_THAT(table, Not(HasSubstr("keep the limits")));
}

TEST(Tradeoff, WhatIsNotKnownForOneStartIsNotKnown) {
  RunFigures unknown = run("A", "none", 15.0, 3.0);
  unknown.effort_per_m.reset();
  const std::string table = tradeoff_markdown({run("A", "none", 15.0, 1.0), unknown});
  EXPECT_THAT(table, HasSubstr("| A | 15.00 | 20.0 | - | 4.000 |"));
  EXPECT_THAT(table, HasSubstr("| lap [s], effort per m | - | - |"));
  EXPECT_THAT(table, HasSubstr("| lap [s], comfort per m | A |"));
  EXPECT_THAT(tradeoff_csv({run("A", "none", 15.0, 1.0), unknown}),
              HasSubstr("\ns,default,A,none,15.000000,20.000000,,4.000000,"));
}

/// Fixed: fast with effort, slow without. The policy is between them, nearer to the best of both.
const std::vector<RunFigures> kThree{run("fast", "none", 10.0, 10.0, 0.5),
                                     run("slow", "none", 20.0, 2.0, 0.0),
                                     run("slow", "mixed", 12.0, 3.0, 0.005)};

TEST(Tradeoff, SaysWhoIsDominatedByNobodyAndWhatAPolicyAdds) {
  const std::string table = tradeoff_markdown(kThree);
  // Reference point (21, 10.5): 11 x 0.5 + 1 x 8.5 - 1 x 0.5 = 13.5. The policy adds the rectangle
  // from (12, 3) to (20, 10): (13.5 + 8 x 7) / 13.5 = 5.148.
  EXPECT_THAT(table,
              HasSubstr("| lap [s], effort per m | fast, slow, policy mixed | 13.500 | 5.148 |\n"));
  EXPECT_THAT(table, HasSubstr("lap [s], effort per m: 21.00, 10.500;"));
}

TEST(Tradeoff, MarksWhoDoesNotKeepTheLimitsAndLetsTheOthersCompeteAlone) {
  const std::string table = tradeoff_markdown(kThree);
  EXPECT_THAT(table, HasSubstr("| fast (!) |"));
  EXPECT_THAT(table, HasSubstr("| slow | 20.00 |"));
  EXPECT_THAT(table, HasSubstr("| policy mixed | 12.00 |"));
  const std::string within = table.substr(table.find("### Rows that keep the limits"));
  EXPECT_THAT(within, HasSubstr("| lap [s], effort per m | slow, policy mixed | 8.500 |"));
  // In one start of two is enough.
  EXPECT_THAT(
      tradeoff_markdown({run("A", "none", 10.0, 1.0, 0.0), run("A", "none", 10.0, 1.0, 0.1)}),
      HasSubstr("| A (!) |"));
}

TEST(Tradeoff, WithoutAFixedOneThatKeepsTheLimitsThereIsNothingToRelateTo) {
  const std::string table = tradeoff_markdown(
      {run("fast", "none", 10.0, 10.0, 0.5), run("fast", "zone", 12.0, 3.0, 0.0)});
  const std::string within = table.substr(table.find("### Rows that keep the limits"));
  EXPECT_THAT(within, HasSubstr("| policy zone | 0.000 | 4.500 (of none) |"));
}

TEST(Tradeoff, TellsWhatAPolicyPlannedOn) {
  RunFigures one = run("A", "zone", 15.0, 1.0);
  one.subgraph_shares = {{"A", 0.5}, {"A, at most 0.4 m/s", 0.5}};
  RunFigures other = run("A", "zone", 15.0, 1.0);
  other.subgraph_shares = {{"A", 0.9}, {"A, label J1", 0.1}};
  EXPECT_THAT(tradeoff_markdown({one, other}),
              HasSubstr("* policy zone: A 70.0 %; A, at most 0.4 m/s 25.0 %; A, label J1 5.0 %\n"));
}

TEST(Tradeoff, NamesThatAreHostileToTablesBreakNone) {
  const std::vector<RunFigures> runs{run("A", "none", 15.0, 1.0), run("A", "a|b,\"c\"", 14.0, 1.0)};
  EXPECT_THAT(tradeoff_markdown(runs), HasSubstr("| policy a\\|b,\"c\" | 14.00 |"));
  EXPECT_THAT(tradeoff_csv(runs), HasSubstr("\ns,default,A,\"a|b,\"\"c\"\"\",14.000000,"));
}

TEST(Tradeoff, FrontsAsCommaSeparatedValues) {
  const std::string fronts = tradeoff_fronts_csv(kThree);
  EXPECT_THAT(fronts,
              HasSubstr("\ns,default,all,lap_s,effort_per_m,21.000000,10.500000,slow,none,1,"
                        "13.500000,13.500000\n"));
  EXPECT_THAT(fronts, HasSubstr("\ns,default,within_limits,lap_s,effort_per_m,21.000000,10.500000,"
                                "slow,mixed,1,8.500000,"));
  EXPECT_THAT(fronts, Not(HasSubstr("within_limits,lap_s,effort_per_m,21.000000,10.500000,fast")));
}

}  // namespace
}  // namespace hlc::campaign::tradeoff_test
