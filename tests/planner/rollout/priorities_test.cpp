// Priorities that change from step to step, in controllers that are stepped together.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "planner/coordination/priorities/strategies.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plans_in_force.hpp"

namespace hlc::rollout::priorities_test {
namespace {

scenario::Scenario on_circle(const coordination::PriorityStrategy& strategy, std::size_t cars) {
  return scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/circle.yaml",
       .priorities = std::string(strategy.name),
       .cars = cars});
}

/// Without its new plan; sum of the costs of the others.
struct Cost {
  std::size_t without_plan{};
  double cost_m2{};
};

Cost cost_of(const std::vector<coordination::Report>& reports) {
  Cost cost;
  for (const coordination::Report& report : reports) {
    if (report.status != coordination::StepStatus::kPlanned) ++cost.without_plan;
    cost.cost_m2 += report.cost_m2;
  }
  return cost;
}

class EachStrategy : public testing::TestWithParam<const coordination::PriorityStrategy*> {};

// In two rounds each controller chooses the order for itself, from replicas; in one process they
// can choose it once.
TEST_P(EachStrategy, LeadsToTheSameStepsInTwoRoundsAndOneAfterTheOther) {
  const scenario::Scenario scenario = [] {
    scenario::Scenario of_four = on_circle(*GetParam(), 4);
    of_four.rounds = controller::Rounds::kTwo;
    return of_four;
  }();
  Rollout sequential = make_rollout(scenario);
  Rollout two_rounds = make_rollout(scenario);
  two_rounds.exchange_in(controller::Rounds::kTwo);
  for (int step = 0; step < 25; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const std::vector<coordination::Report> expected = sequential.step();
    const std::vector<coordination::Report> reports = two_rounds.step();
    for (std::size_t i = 0; i < reports.size(); ++i) {
      EXPECT_EQ(reports[i].status, expected[i].status);
      EXPECT_EQ(reports[i].level, expected[i].level);
      EXPECT_EQ(reports[i].cost_m2, expected[i].cost_m2);
      EXPECT_EQ(reports[i].plan, expected[i].plan);
    }
  }
}

TEST_P(EachStrategy, NeverLeadsToPlansThatMeetWhateverIsLost) {
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(5); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::bernoulli_distribution is_lost(0.02 + 0.03 * static_cast<double>(seed));
    scenario::Scenario scenario = on_circle(*GetParam(), 4);
    if (seed % 2 == 0) scenario.rounds = controller::Rounds::kTwo;
    scenario.profile.strategies.priorities.max_levels = seed % 3;  // 0: no limit
    Rollout rollout = make_rollout(scenario);
    rollout.exchange_in(scenario.rounds);
    rollout.lose([&](const controller::Delivery&) { return is_lost(random); });
    for (int step = 0; step < 25; ++step) {
      static_cast<void>(rollout.step());
      ASSERT_TRUE(test::plans_in_force_are_free(rollout)) << "step " << step;
    }
  }
}

class EachThatComparesPlans : public EachStrategy {};

// Of several orders it takes none that is worse than the constant one in the same situation.
TEST_P(EachThatComparesPlans, FindsNoWorseOnesThanTheConstantOrder) {
  std::size_t better = 0;
  for (std::size_t cars = 3; cars <= 5; ++cars) {
    Rollout rollout = make_rollout(on_circle(*GetParam(), cars));
    for (int step = 0; step < 20; ++step) {
      SCOPED_TRACE(std::to_string(cars) + " cars, step " + std::to_string(step));
      Rollout constant = rollout.clone();
      for (const auto& one : constant.controllers()) {
        one->coordinate_by({}, one->options().strategies.coordination);
      }
      const Cost expected = cost_of(constant.step());
      const Cost found = cost_of(rollout.step());
      EXPECT_LE(found.without_plan, expected.without_plan);
      if (found.without_plan < expected.without_plan) continue;
      EXPECT_LE(found.cost_m2, expected.cost_m2 + 1e-9);
      if (found.cost_m2 < expected.cost_m2 - 1e-9) ++better;
    }
  }
  EXPECT_GT(better, 0U);
}

/// The controllers plan in this order from the next step on.
void fix(const Rollout& rollout, const std::vector<VehicleId>& order) {
  for (const auto& one : rollout.controllers()) {
    one->coordinate_by({.first = order}, one->options().strategies.coordination);
  }
}

// The plans of the chosen order are those of several trials, of which none is made again: equal to
// those of controllers that plan in this order only, also where a prediction is lost on which a
// kept plan was based.
TEST_P(EachThatComparesPlans, KeepsThePlansThatItsOrderLeadsToWhateverIsLost) {
  std::size_t other_orders = 0;
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(6); ++seed) {
    const auto is_lost = [seed](const controller::Delivery& one) {
      return seed % 2 == 1 && one.kind == controller::MessageKind::kPrediction &&
             (one.from.value * 7U + one.to.value * 3U + one.step.value + seed) % 4 == 0;
    };
    const std::size_t cars = 3 + seed % 3;
    Rollout rollout = make_rollout(on_circle(*GetParam(), cars));
    for (int step = 0; step < 15; ++step) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
      Rollout fixed = rollout.clone();
      fixed.lose(is_lost);
      rollout.lose(is_lost);
      const std::vector<coordination::Report> reports = rollout.step();
      std::vector<VehicleId> order;
      for (const auto& one : rollout.controllers()) order.push_back(one->options().vehicle);
      const std::vector<VehicleId> by_id = order;
      std::ranges::sort(order, rollout.controllers().front()->plans_before());
      other_orders += order == by_id ? 0U : 1U;
      fix(fixed, order);
      const std::vector<coordination::Report> expected = fixed.step();
      for (std::size_t i = 0; i < reports.size(); ++i) {
        EXPECT_EQ(reports[i].status, expected[i].status);
        EXPECT_EQ(reports[i].level, expected[i].level);
        EXPECT_EQ(reports[i].cost_m2, expected[i].cost_m2);
        EXPECT_EQ(reports[i].expanded, expected[i].expanded);
        EXPECT_EQ(reports[i].plan, expected[i].plan);
      }
    }
  }
  EXPECT_GT(other_orders, 0U);
}

INSTANTIATE_TEST_SUITE_P(Priorities, EachStrategy,
                         testing::ValuesIn(coordination::priority_strategies().begin(),
                                           coordination::priority_strategies().end()),
                         [](const auto& tested) { return std::string(tested.param->name); });

INSTANTIATE_TEST_SUITE_P(Priorities, EachThatComparesPlans,
                         testing::Values(&coordination::kExplorativePriorities,
                                         &coordination::kOptimalPriorities,
                                         &coordination::kBestOrder),
                         [](const auto& tested) { return std::string(tested.param->name); });

// Trials used to plan in an order without those that the rule names first, so that a vehicle
// planned before its predecessor.
TEST(OrderSearch, LeavesThoseFirstThatTheRuleNames) {
  scenario::Scenario scenario = on_circle(coordination::kOptimalPriorities, 4);
  scenario.profile.strategies.priorities.first = {{4}, {2}};
  Rollout rollout = make_rollout(scenario);
  for (int step = 0; step < 15; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    Rollout fixed = rollout.clone();
    for (const auto& one : fixed.controllers()) {
      one->coordinate_by({.first = {{4}, {2}}}, one->options().strategies.coordination);
    }
    const Cost expected = cost_of(fixed.step());
    const std::vector<coordination::Report> reports = rollout.step();
    EXPECT_EQ(reports[3].level, 0U);
    EXPECT_LE(reports[1].level, 1U);
    const Cost found = cost_of(reports);
    EXPECT_LE(found.without_plan, expected.without_plan);
    if (found.without_plan == expected.without_plan) {
      EXPECT_LE(found.cost_m2, expected.cost_m2 + 1e-9);
    }
  }
}

// The limit is kept at the price of plans that do not come into force, since neither of two
// vehicles that plan at the same time knows the other's new plan.
TEST(MaxLevels, AreKeptInEveryStep) {
  scenario::Scenario scenario = on_circle(coordination::kConstantPriorities, 6);
  scenario.profile.strategies.priorities.max_levels = 2;
  Rollout rollout = make_rollout(scenario);
  std::uint32_t highest = 0;
  for (int step = 0; step < 25; ++step) {
    for (const coordination::Report& report : rollout.step()) {
      highest = std::max(highest, report.level);
    }
    ASSERT_TRUE(test::plans_in_force_are_free(rollout)) << "step " << step;
  }
  EXPECT_EQ(highest, 1U);
}

}  // namespace
}  // namespace hlc::rollout::priorities_test
