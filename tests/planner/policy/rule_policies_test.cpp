#include "planner/policy/rule_policies.hpp"

#include <gtest/gtest.h>

namespace hlc::policy::rule_policies_test {
namespace {

const SubgraphRequest kEffort{.labels = {"J2"}};
const SubgraphRequest kAgile{.labels = {"J1"}};

std::unique_ptr<Policy> made(const PolicySettings& settings) { return make_policy(settings); }

coordination::Report report(coordination::StepStatus status, std::vector<VehicleId> coupled = {}) {
  return {.vehicle = {1}, .step = {}, .status = status, .coupled = std::move(coupled)};
}

TEST(TimePolicy, HasNoOpinionBeforeItsFirstTimeAndThenThatOfTheLastOneThatHasCome) {
  const auto policy =
      made(TimePolicySettings{.changes = {{1.0, kEffort}, {2.0, {}}, {3.0, kAgile}}});
  EXPECT_EQ(policy->propose({.time_s = 0.8}), std::nullopt);
  EXPECT_EQ(policy->propose({.time_s = 5 * 0.2}), kEffort);
  EXPECT_EQ(policy->propose({.time_s = 1.8}), kEffort);
  EXPECT_EQ(policy->propose({.time_s = 2.0}), SubgraphRequest{});
  EXPECT_EQ(policy->propose({.time_s = 100.0}), kAgile);
  EXPECT_EQ(policy->choices(), (std::vector<SubgraphRequest>{kEffort, {}, kAgile}));
}

// 15 * 0.2 is more than 3, 3 * 0.2 more than 0.6, and 0.2 + 0.2 + 0.2 too: an exact comparison
// changes a step late or early.
TEST(TimePolicy, ChangesInTheStepOfItsTimeWhateverTheRounding) {
  for (std::size_t steps = 1; steps < 2000; ++steps) {
    const double from_s = static_cast<double>(2 * steps) / 10.0;
    const auto policy = made(TimePolicySettings{.changes = {{from_s, kEffort}}});
    EXPECT_FALSE(policy->propose({.time_s = 0.2 * static_cast<double>(steps - 1)})) << steps;
    EXPECT_TRUE(policy->propose({.time_s = 0.2 * static_cast<double>(steps)})) << steps;
  }
}

TEST(SituationPolicy, IsInConflictWhileCoupledOrFallenBackAndAWhileAfter) {
  const auto policy = made(
      SituationPolicySettings{.open_road = kEffort, .conflict = kAgile, .after_conflict_s = 0.4});
  const coordination::Report open = report(coordination::StepStatus::kPlanned);
  const coordination::Report coupled = report(coordination::StepStatus::kPlanned, {{2}});
  const coordination::Report fallen_back = report(coordination::StepStatus::kFallback);
  EXPECT_EQ(policy->propose({.time_s = 0.0}), kEffort) << "nothing is known yet";
  EXPECT_EQ(policy->propose({.time_s = 0.2, .last = &open}), kEffort);
  EXPECT_EQ(policy->propose({.time_s = 0.4, .last = &coupled}), kAgile);
  EXPECT_EQ(policy->propose({.time_s = 0.6, .last = &open}), kAgile);
  EXPECT_EQ(policy->propose({.time_s = 0.8, .last = &open}), kAgile) << "0.4 s after";
  EXPECT_EQ(policy->propose({.time_s = 1.0, .last = &open}), kEffort);
  EXPECT_EQ(policy->propose({.time_s = 1.2, .last = &fallen_back}), kAgile);
}

TEST(BatteryPolicy, StaysAsItWasBetweenItsBoundsAndWhereNothingIsKnown) {
  const auto policy =
      made(BatteryPolicySettings{.below_v = 7.0, .back_above_v = 7.4, .request = kEffort});
  EXPECT_EQ(policy->propose({}), std::nullopt);
  EXPECT_EQ(policy->propose({.battery_v = 7.0}), std::nullopt);
  EXPECT_EQ(policy->propose({.battery_v = 6.9}), kEffort);
  EXPECT_EQ(policy->propose({.battery_v = 7.3}), kEffort);
  EXPECT_EQ(policy->propose({}), kEffort);
  EXPECT_EQ(policy->propose({.battery_v = 7.5}), std::nullopt);
  EXPECT_EQ(policy->propose({.battery_v = 7.3}), std::nullopt);
}

}  // namespace
}  // namespace hlc::policy::rule_policies_test
