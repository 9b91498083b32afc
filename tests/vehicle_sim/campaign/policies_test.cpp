// Campaigns that drive policies beside fixed subgraphs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/folders.hpp"
#include "vehicle_sim/campaign/campaign.hpp"

namespace hlc::campaign::policies_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kScenario =
    test::source_folder() + "/launch_scripts/scenarios/reconfiguration.yaml";

CampaignPlan plan(std::vector<std::string> subgraphs, std::vector<std::string> policies) {
  return {.scenarios = {kScenario},
          .profiles = {"default"},
          .subgraphs = std::move(subgraphs),
          .policies = std::move(policies),
          .steps = 25};
}

RunFigures figures_of(const Campaign& campaign, std::size_t run) {
  return with_figures(campaign.heading_of(run), campaign.result_of(campaign.drive(run, {})));
}

TEST(Policies, AreDrivenOnTheScenariosOwnSubgraphAfterTheFixedOnes) {
  CampaignPlan two_starts = plan({"J1", "comfort"}, {"zone", "time"});
  two_starts.starts = 2;
  std::vector<std::string> names;
  for (const CampaignRun& run : runs_of(two_starts)) {
    names.push_back(run.subgraph.value_or("own") + " " + run.policy.value_or("fixed") + " " +
                    std::to_string(run.start));
  }
  EXPECT_THAT(names,
              testing::ElementsAre("J1 fixed 0", "J1 fixed 1", "comfort fixed 0", "comfort fixed 1",
                                   "own zone 0", "own zone 1", "own time 0", "own time 1"));
}

// The file itself names a policy.
TEST(Policies, AFixedSubgraphStaysAndAPolicySwitches) {
  const Campaign campaign(plan({}, {"zone"}));
  ASSERT_EQ(campaign.runs().size(), 2U);
  const RunFigures fixed = figures_of(campaign, 0);
  EXPECT_EQ(fixed.policy, "none");
  EXPECT_EQ(fixed.switches, 0U);
  EXPECT_EQ(fixed.subgraph_shares, (std::map<std::string, double>{{"J2", 1.0}}));
  const RunFigures zone = figures_of(campaign, 1);
  EXPECT_EQ(zone.policy, "zone");
  EXPECT_EQ(zone.subgraph, "J2");
  EXPECT_GT(zone.switches, 0U);
  EXPECT_THAT(zone.subgraph_shares, testing::Contains(testing::Key("J2, at most 0.6 m/s")));
  // Both are judged by the policy's zone.
  ASSERT_TRUE(fixed.clearly_above_limit_share && zone.clearly_above_limit_share);
  EXPECT_GT(*fixed.clearly_above_limit_share, 0.5);
  EXPECT_LT(*zone.clearly_above_limit_share, 0.01);
  EXPECT_TRUE(fixed.effort_per_m && fixed.comfort_per_m);
  EXPECT_GE(*fixed.comfort_per_m, *fixed.effort_per_m);
}

TEST(Policies, WithoutThemNobodyIsJudgedByZones) {
  const Campaign campaign(plan({}, {}));
  ASSERT_EQ(campaign.runs().size(), 1U);
  const RunFigures fixed = figures_of(campaign, 0);
  EXPECT_EQ(fixed.above_limit_share, std::nullopt);
  EXPECT_EQ(fixed.switches, 0U);
}

TEST(Policies, WhatTheScenarioDoesNotHaveIsRefusedWithWhatItHas) {
  EXPECT_THAT(
      [] {
        Campaign(plan({}, {"zone", "zones"}));
      },
      ThrowsMessage<std::invalid_argument>(
          AllOf(HasSubstr("--policies = zones, must be one of " + kScenario),
                HasSubstr(": look_ahead, mixed, situation, time, zone, zone_look_ahead, "
                          "zone_reference"))));
  EXPECT_THAT([] { Campaign(plan({}, {"none"})); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("--policies = none, must be one of"), HasSubstr("--subgraphs"))));
  CampaignPlan without = plan({}, {"zone"});
  without.scenarios = {test::source_folder() + "/launch_scripts/scenarios/paper_red_alone.yaml"};
  EXPECT_THAT([&] { Campaign{without}; },
              ThrowsMessage<std::invalid_argument>(HasSubstr("it has none")));
}

}  // namespace
}  // namespace hlc::campaign::policies_test
