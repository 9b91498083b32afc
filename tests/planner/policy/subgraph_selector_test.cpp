#include "planner/policy/subgraph_selector.hpp"

#include <gtest/gtest.h>

#include "tests/planner/policy/driven_controller.hpp"

namespace hlc::policy::subgraph_selector_test {
namespace {

using test::DrivenController;

const SubgraphRequest kSlowLabel{.labels = {"slow"}};
const SubgraphRequest kFastLabel{.labels = {"fast"}};

SpeedZone zone(double min_x_m, double max_x_m, double max_speed_mps) {
  return {.min_x_m = min_x_m,
          .max_x_m = max_x_m,
          .min_y_m = -1.0,
          .max_y_m = 1.0,
          .max_speed_mps = max_speed_mps};
}

constexpr StepIndex kStart{101};

class SubgraphSelectorTest : public testing::Test {
 protected:
  void use(const ReconfigurationSettings& settings) { selector_.emplace(*car_, settings); }

  /// One step with the choice before and after; the name of what was planned on.
  std::string drive(std::optional<double> battery_v = {}) {
    static_cast<void>(selector_->begin_step(*car_, car_.next_step(), kStart, battery_v));
    std::string name = car_->subgraph().spec().name;
    selector_->end_step(*car_, car_.step());
    return name;
  }

  void ask(const SubgraphRequest& request) {
    selector_->ask(std::make_shared<const PreparedChoice>(
        selector_->base(), request, selector_->limits_mps(), 8, search::SearchOptions{}));
  }

  DrivenController car_;
  std::optional<SubgraphSelector> selector_;
};

TEST_F(SubgraphSelectorTest, WithoutZonesAndPoliciesItStaysAsItIs) {
  use({});
  const auto subgraph = car_->prepared_subgraph().subgraph;
  for (int k = 0; k < 5; ++k) {
    EXPECT_FALSE(selector_->begin_step(*car_, car_.next_step(), kStart, 1.0));
    selector_->end_step(*car_, car_.step());
  }
  EXPECT_EQ(car_->prepared_subgraph().subgraph, subgraph);
}

TEST_F(SubgraphSelectorTest, APolicyIsAskedInTheFirstStep) {
  use({.policies = {TimePolicySettings{.changes = {{0.0, kFastLabel}}}}});
  EXPECT_FALSE(selector_->begin_step(*car_, car_.next_step(), {}, {})) << "it has not begun";
  EXPECT_EQ(drive(), "slow, label fast");
}

// Also for a controller that comes back into a run.
TEST_F(SubgraphSelectorTest, TimeCountsFromTheExperimentsFirstStepOn) {
  use({.policies = {TimePolicySettings{.changes = {{1.0, kFastLabel}}}}});
  for (int k = 0; k < 3; ++k) {
    static_cast<void>(selector_->begin_step(*car_, car_.next_step(), {}, {}));
    static_cast<void>(car_.step());
  }
  EXPECT_EQ(drive(), "slow");  // 3 steps after it
  EXPECT_EQ(drive(), "slow");
  EXPECT_EQ(drive(), "slow, label fast");
}

TEST_F(SubgraphSelectorTest, OfSeveralPoliciesTheFirstWithAnOpinionCounts) {
  use({.policies = {BatteryPolicySettings{
                        .below_v = 7.0, .back_above_v = 7.0, .request = {.max_speed_mps = 0.6}},
                    TimePolicySettings{.changes = {{0.0, kFastLabel}}}},
       .min_stay_s = 0.0});
  EXPECT_EQ(drive(7.5), "slow, label fast");
  EXPECT_EQ(drive(6.5), "slow, at most 0.6 m/s");
  EXPECT_EQ(drive(7.5), "slow, label fast");
}

// A policy that changes its mind in every step.
TEST_F(SubgraphSelectorTest, WhatAPolicyAskedForStaysAWhile) {
  use({.policies = {BatteryPolicySettings{
           .below_v = 7.0, .back_above_v = 7.0, .request = kFastLabel}},
       .min_stay_s = 1.0});
  int switches = 0;
  std::string last = "slow";
  for (int k = 0; k < 50; ++k) {
    const std::string now = drive(k % 2 == 0 ? 6.0 : 8.0);
    switches += now != last ? 1 : 0;
    last = now;
  }
  EXPECT_GE(switches, 5);
  EXPECT_LE(switches, 20) << "two in a second";
}

// A weak battery need not wait until the road has been open for long enough.
TEST_F(SubgraphSelectorTest, APolicyBeforeTheOneThatChoseNeedNotWait) {
  use({.policies = {BatteryPolicySettings{
                        .below_v = 7.0, .back_above_v = 7.0, .request = kFastLabel},
                    TimePolicySettings{.changes = {{0.0, {.max_speed_mps = 0.7}}}}},
       .min_stay_s = 1.0});
  EXPECT_EQ(drive(8.0), "slow, at most 0.7 m/s");
  EXPECT_EQ(drive(6.0), "slow, label fast");
  for (int k = 0; k < 4; ++k) EXPECT_EQ(drive(8.0), "slow, label fast");
  EXPECT_EQ(drive(8.0), "slow, at most 0.7 m/s");
}

TEST_F(SubgraphSelectorTest, TheOperatorWinsOverPoliciesUntilHeGivesTheVehicleBack) {
  use({.policies = {TimePolicySettings{.changes = {{0.0, kFastLabel}}}}});
  EXPECT_EQ(drive(), "slow, label fast");
  ask({.max_speed_mps = 0.6});
  EXPECT_EQ(drive(), "slow, at most 0.6 m/s");
  EXPECT_EQ(drive(), "slow, at most 0.6 m/s");
  selector_->ask(nullptr);
  EXPECT_EQ(drive(), "slow, label fast");
}

TEST_F(SubgraphSelectorTest, AZonesLimitIsLaidOnWhateverIsAskedFor) {
  use({.zones = {zone(-1.0, 100.0, 0.5)},
       .policies = {TimePolicySettings{.changes = {{0.0, kFastLabel}}}}});
  EXPECT_EQ(drive(), "slow, at most 0.5 m/s") << "with fast maneuvers it cannot be held";
  ask({.disable_trims = {{11}}});
  EXPECT_EQ(drive(), "slow, at most 0.5 m/s, without trims 12");
  ask({.max_speed_mps = 0.4});
  EXPECT_EQ(drive(), "slow, at most 0.4 m/s") << "never lifted by a zone";
  ask({.max_speed_mps = 0.7});
  EXPECT_EQ(drive(), "slow, at most 0.5 m/s");
}

// Alone, on a straight road: as fast as ever before the zone and behind it, never too fast in it.
// Fast maneuvers outrun their trims.
TEST_F(SubgraphSelectorTest, NoCarIsTooFastInAZone) {
  const SpeedZone slow = zone(2.0, 4.0, 0.4);
  use({.zones = {slow},
       .policies = {TimePolicySettings{.changes = {{0.0, {.labels = {"slow", "fast"}}}}}}});
  int in_zone = 0;
  double fastest_mps = 0.0;
  for (int k = 0; k < 75; ++k) {
    static_cast<void>(drive());
    for (const double time_s : {0.0, 0.05, 0.1, 0.15}) {
      const vehicle::State state = car_->plan_in_force().state_at(
          {car_.next_step().value - 1}, time_s, car_->subgraph().automaton().vehicle);
      fastest_mps = std::max(fastest_mps, state.speed_mps);
      if (state.pose.x_m < slow.min_x_m || state.pose.x_m > slow.max_x_m) continue;
      ++in_zone;
      EXPECT_LE(state.speed_mps, slow.max_speed_mps + 1e-6) << "at x = " << state.pose.x_m;
    }
  }
  EXPECT_GT(in_zone, 60);
  EXPECT_GT(fastest_mps, 0.75);
  EXPECT_GT(car_->plan_in_force().pose_at(car_.next_step()).x_m, slow.max_x_m + 1.0);
}

// On the same road, where only the reference is limited: the label whose maneuvers outrun their
// trims stays, and no trim is left out, but the car is drawn to the limit, from the same place on.
TEST_F(SubgraphSelectorTest, ZonesThatLimitTheReferenceLeaveTheSubgraphAsItIs) {
  const SpeedZone slow = zone(2.0, 4.0, 0.4);
  const auto limited = [&slow](ZonesLimit zones_limit) {
    return ReconfigurationSettings{
        .zones = {slow},
        .zones_limit = zones_limit,
        .policies = {TimePolicySettings{.changes = {{0.0, {.labels = {"slow", "fast"}}}}}}};
  };
  use(limited(ZonesLimit::kSubgraph));
  const double ahead_m = selector_->zone_ahead_m();
  use(limited(ZonesLimit::kReference));
  EXPECT_EQ(selector_->zone_ahead_m(), ahead_m);
  static_cast<void>(drive());
  const std::uint64_t basis = car_->planning_basis();
  int slow_steps = 0;
  for (int k = 0; k < 75; ++k) {
    const double x_m = car_->plan_in_force().pose_at(car_.next_step()).x_m;
    const bool is_slow = x_m + ahead_m >= slow.min_x_m && x_m <= slow.max_x_m;
    slow_steps += is_slow ? 1 : 0;
    EXPECT_EQ(drive(), "slow, labels slow, fast");
    EXPECT_EQ(car_->options().reference_speed_mps, is_slow ? 0.4 : 0.8) << "at x = " << x_m;
    EXPECT_EQ(selector_->decision().zone.has_value(), is_slow);
    EXPECT_EQ(selector_->decision().subgraph_limit_mps, std::nullopt);
    EXPECT_EQ(car_->planning_basis() != basis, is_slow) << "others cannot plan for it";
    if (x_m < slow.min_x_m + 0.5 || x_m > slow.max_x_m) continue;
    const double driven_m = car_->plan_in_force().pose_at(car_.next_step()).x_m - x_m;
    EXPECT_NEAR(driven_m, 0.4 * car_->subgraph().automaton().step_s, 0.02) << "at x = " << x_m;
  }
  EXPECT_GT(slow_steps, 20);
  EXPECT_GT(car_->plan_in_force().pose_at(car_.next_step()).x_m, slow.max_x_m + 1.0);
}

TEST_F(SubgraphSelectorTest, ALookAheadHasTheLimitedReferenceInARollout) {
  use({.zones = {zone(-1.0, 100.0, 0.4)},
       .zones_limit = ZonesLimit::kReference,
       .policies = {LookAheadSettings{.candidates = {kSlowLabel, {.max_speed_mps = 0.5}},
                                      .steps = 4,
                                      .max_expansions = 10'000}},
       .min_stay_s = 0.0});
  for (int k = 0; k < 6; ++k) static_cast<void>(drive());
  EXPECT_EQ(drive(), "slow, label slow") << "a limit of 0.5 m/s costs nothing";
  EXPECT_EQ(car_->options().reference_speed_mps, 0.4);
}

// Where it is in a fallback is not where it planned last.
TEST_F(SubgraphSelectorTest, AZoneIsSeenFromWhereTheCarIsAlsoWhenNothingNewIsPlanned) {
  use({.zones = {zone(1.5, 3.0, 0.4)}});
  for (int k = 0; k < 6; ++k) static_cast<void>(drive());
  const double before_m = car_->plan_in_force().pose_at(car_.next_step()).x_m;
  ASSERT_LT(before_m + selector_->zone_ahead_m(), 1.5);
  car_->set_minimal_risk_stop(true);
  bool is_seen = false;
  for (int k = 0; k < 8; ++k) {
    const std::string name = drive();
    const double x_m = car_->plan_in_force().pose_at({car_.next_step().value - 1}).x_m;
    EXPECT_EQ(name != "slow", x_m + selector_->zone_ahead_m() >= 1.5) << x_m;
    is_seen = is_seen || name != "slow";
  }
  EXPECT_TRUE(is_seen);
}

TEST_F(SubgraphSelectorTest, ALookAheadTakesWhatARolloutCostsLeast) {
  const LookAheadSettings settings{.candidates = {kSlowLabel, kFastLabel},
                                   .steps = 4,
                                   .criterion_weights = {{"fast", 10.0}},
                                   .max_expansions = 10'000};
  use({.policies = {settings}, .min_stay_s = 0.0});
  EXPECT_EQ(drive(), "slow") << "nothing has been rolled out yet";
  EXPECT_EQ(drive(), "slow, label slow");
}

TEST_F(SubgraphSelectorTest, ALookAheadSeesWhatALimitCosts) {
  use({.policies = {LookAheadSettings{.candidates = {{.max_speed_mps = 0.5}, kSlowLabel},
                                      .steps = 4,
                                      .max_expansions = 10'000}},
       .min_stay_s = 0.0});
  for (int k = 0; k < 6; ++k) static_cast<void>(drive());
  EXPECT_EQ(drive(), "slow, label slow");
}

// Two candidates that are the same: rounding must not decide in every step.
TEST_F(SubgraphSelectorTest, ALookAheadKeepsItsChoiceUnlessAnotherGains) {
  use({.policies = {LookAheadSettings{.candidates = {{.max_speed_mps = 0.8}, kSlowLabel},
                                      .steps = 4,
                                      .max_expansions = 10'000}},
       .min_stay_s = 0.0});
  static_cast<void>(drive());
  const std::string first = drive();
  for (int k = 0; k < 30; ++k) EXPECT_EQ(drive(), first);
}

TEST_F(SubgraphSelectorTest, WhileTheOperatorHasAskedNothingIsRolledOut) {
  use({.policies = {LookAheadSettings{
           .candidates = {kSlowLabel, kFastLabel}, .steps = 4, .max_expansions = 10'000}}});
  EXPECT_TRUE(selector_->looks_ahead());
  ask(kFastLabel);
  EXPECT_FALSE(selector_->looks_ahead());
}

}  // namespace
}  // namespace hlc::policy::subgraph_selector_test
