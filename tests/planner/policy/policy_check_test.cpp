#include "planner/policy/policy_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_automaton.hpp"

namespace hlc::policy::policy_check_test {
namespace {

const SubgraphRequest kSlowLabel{.labels = {"slow"}};
const SubgraphRequest kFastLabel{.labels = {"fast"}};

std::string refusal_of(const ReconfigurationSettings& settings) {
  static const automaton::Subgraph base =
      test::make_test_subgraph({test::kSlow, test::kFast}, test::kAllTrims);
  try {
    check_reconfiguration(base, settings, 8, {});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

SpeedZone zone(double max_speed_mps) {
  return {.min_x_m = 0.0,
          .max_x_m = 1.0,
          .min_y_m = 0.0,
          .max_y_m = 1.0,
          .max_speed_mps = max_speed_mps};
}

TEST(PolicyCheck, EveryRequestIsListedOnceAndTheScenariosOwnFirst) {
  const ReconfigurationSettings settings{
      .policies = {TimePolicySettings{.changes = {{0.0, kSlowLabel}, {1.0, {}}}},
                   SituationPolicySettings{.open_road = kSlowLabel, .conflict = kFastLabel},
                   BatteryPolicySettings{.request = kSlowLabel},
                   LookAheadSettings{.candidates = {kFastLabel, {.max_speed_mps = 0.6}}}}};
  EXPECT_EQ(requests_of(settings),
            (std::vector<SubgraphRequest>{{}, kSlowLabel, kFastLabel, {.max_speed_mps = 0.6}}));
}

TEST(PolicyCheck, WhatCannotBeIsRefusedWithItsReason) {
  EXPECT_EQ(refusal_of({}), "");
  EXPECT_EQ(refusal_of({.zones = {zone(0.5)},
                        .policies = {TimePolicySettings{.changes = {{0.0, kSlowLabel}}}}}),
            "");
  EXPECT_THAT(refusal_of({.policies = {TimePolicySettings{.changes = {{0.0, {{"J7"}}}}}}}),
              testing::HasSubstr("label 'J7', must be one of fast, slow"));
  EXPECT_THAT(refusal_of({.zones = {zone(0.5), zone(0.2)}}),
              testing::HasSubstr("in the zone of 0.2 m/s: speed limit 0.2 m/s, must be >="));
}

// The automaton of tests holds no criteria.
TEST(PolicyCheck, ALookAheadByACriterionThatNoManeuverHoldsIsRefused) {
  LookAheadSettings settings{.candidates = {kSlowLabel, kFastLabel}};
  EXPECT_EQ(refusal_of({.policies = {settings}}), "");
  settings.criterion_weights = {{"J2", 0.1}};
  EXPECT_THAT(refusal_of({.policies = {settings}}), testing::HasSubstr("J2"));
}

}  // namespace
}  // namespace hlc::policy::policy_check_test
