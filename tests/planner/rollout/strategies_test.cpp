// Every rule of the registries but priorities (priorities_test.cpp), in controllers that are
// stepped together.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "planner/controller/coordination_rules.hpp"
#include "planner/coordination/coupling_rule.hpp"
#include "planner/road/reference_points.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plans_in_force.hpp"

namespace hlc::rollout::strategies_test {
namespace {

/// Plans in force stay free of each other while messages are lost, and the cars get on.
void expect_free_whatever_is_lost(const scenario::Scenario& scenario, std::uint64_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::bernoulli_distribution is_lost(0.03 * static_cast<double>(seed));
  Rollout rollout = make_rollout(scenario);
  rollout.exchange_in(scenario.rounds);
  rollout.lose([&](const controller::Delivery&) { return is_lost(random); });
  std::size_t planned = 0;
  for (int step = 0; step < 25; ++step) {
    for (const coordination::Report& report : rollout.step()) {
      if (report.status == coordination::StepStatus::kPlanned) ++planned;
    }
    ASSERT_TRUE(test::plans_in_force_are_free(rollout)) << "step " << step;
  }
  EXPECT_GT(planned, 25U);
}

scenario::Scenario on_circle() {
  return scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/circle.yaml", .cars = 4});
}

void expect_free_whatever_is_lost(scenario::Scenario scenario) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(4); ++seed) {
    scenario.rounds = seed % 2 == 0 ? controller::Rounds::kTwo : controller::Rounds::kSequential;
    expect_free_whatever_is_lost(scenario, seed);
  }
}

TEST(EachCouplingRule, NeverLeadsToPlansThatMeetWhateverIsLost) {
  for (const coordination::CouplingRule* rule : coordination::coupling_rules()) {
    SCOPED_TRACE(rule->name);
    scenario::Scenario scenario = on_circle();
    scenario.profile.strategies.coupling = rule;
    expect_free_whatever_is_lost(scenario);
  }
}

TEST(EachReferenceRule, NeverLeadsToPlansThatMeetWhateverIsLost) {
  for (const road::NamedReferenceRule& one : road::reference_rules()) {
    SCOPED_TRACE(one.name);
    scenario::Scenario scenario = on_circle();
    scenario.profile.reference_rule = one.rule;
    expect_free_whatever_is_lost(scenario);
  }
}

// Rules with votes are safe only without losses (commit.hpp).
TEST(EachCoordinationRule, WithoutVotesNeverLeadsToPlansThatMeetWhateverIsLost) {
  std::size_t rules = 0;
  for (const auto& [name, rule] : controller::coordination_rules()) {
    if (rule.commit.needs_votes) continue;
    SCOPED_TRACE(name);
    ++rules;
    scenario::Scenario scenario = on_circle();
    scenario.profile.strategies.coordination = rule;
    expect_free_whatever_is_lost(scenario);
  }
  EXPECT_GE(rules, 2U);
}

}  // namespace
}  // namespace hlc::rollout::strategies_test
