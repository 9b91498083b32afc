#include "planner/scenario/priority_values.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "planner/coordination/priorities/strategies.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::scenario::priority_values_test {
namespace {

using coordination::PriorityRule;
using testing::AllOf;
using testing::HasSubstr;

PriorityRule read(const std::string& text) {
  return read_priorities(Node::parse_yaml(text, "file.yaml"));
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(PriorityValues, AreConstantByDefault) { EXPECT_EQ(read("name: x"), PriorityRule{}); }

TEST(PriorityValues, AreTheNameOfAStrategyOrAMap) {
  EXPECT_EQ(read("priorities: fca").strategy, &coordination::kMostCollisionsFirst);
  EXPECT_EQ(read("priorities: {strategy: optimal, first: [3, 1], max_levels: 4, beyond: "
                 "explorative}"),
            (PriorityRule{.strategy = &coordination::kOptimalPriorities,
                          .first = {{3}, {1}},
                          .max_levels = 4,
                          .beyond = &coordination::kExplorativePriorities}));
  for (const coordination::PriorityStrategy* one : coordination::priority_strategies()) {
    EXPECT_EQ(read("priorities: " + std::string(one->name)).strategy, one);
    EXPECT_EQ(priority_strategy_from_flag(std::string(one->name)), one);
    EXPECT_THAT(priority_strategies_text(), HasSubstr(std::string(one->name) + ": "));
  }
}

TEST(PriorityValues, ThatAreBadAreRefusedInOneLine) {
  EXPECT_THAT(refusal("priorities: fastest"),
              AllOf(HasSubstr("file.yaml:1: priorities = fastest, must be"),
                    HasSubstr("constant, random, fca")));
  EXPECT_THAT(refusal("priorities: {strategy: 3}"), HasSubstr("priorities.strategy = 3, must be"));
  EXPECT_THAT(refusal("priorities: {first: [2, 2]}"),
              HasSubstr("priorities.first[2] = 2, must be an id that is not yet"));
  EXPECT_THAT(refusal("priorities: {first: [0]}"), HasSubstr("priorities.first[1] = 0, must be"));
  EXPECT_THAT(refusal("priorities: {max_levels: 0}"), HasSubstr("max_levels = 0, must be"));
  EXPECT_THAT(refusal("priorities: {beyond: optimal}"), HasSubstr("beyond = optimal, must be"));
  EXPECT_THAT(refusal("priorities: {beyond: fca}"), HasSubstr("beyond = fca, must be constant"));
  EXPECT_THAT(refusal("priorities: {levels: 3}"), HasSubstr("levels"));
  EXPECT_THAT(refusal("priorities: [fca]"), HasSubstr("the name of a strategy or a map"));
}

Scenario circle(const std::string& priorities, const std::string& profile = "default") {
  return read_scenario({.file = test::source_folder() + "/launch_scripts/scenarios/circle.yaml",
                        .profile = profile,
                        .priorities = priorities});
}

TEST(PriorityValues, OfStrategiesThatComparePlansMakeTwoRounds) {
  EXPECT_EQ(circle("random").rounds, controller::Rounds::kSequential);
  EXPECT_EQ(circle("best_order").rounds, controller::Rounds::kTwo);
}

TEST(PriorityValues, OfStrategiesThatComparePlansAreRefusedWithVotes) {
  EXPECT_EQ(circle("random", "2022").profile.strategies.priorities.strategy,
            &coordination::kRandomPriorities);
  for (const auto& [name, profile] :
       {std::pair{"best_order", "2022"}, std::pair{"fastest", "default"}}) {
    try {
      static_cast<void>(circle(name, profile));
      FAIL() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr("--priorities = " + std::string(name) + ", must be"));
    }
  }
}

// Under `agreed` two vehicles that plan at the same time would not keep clear of each other.
TEST(PriorityValues, WithALimitOfLevelsAreRefusedWithVotes) {
  const PriorityRule limited{.max_levels = 2};
  EXPECT_EQ(unsuitable_priorities({}, controller::kAgreedCoordination), "");
  EXPECT_EQ(unsuitable_priorities(limited, controller::kStrictCoordination), "");
  EXPECT_THAT(unsuitable_priorities(limited, controller::kAgreedCoordination),
              HasSubstr("without max_levels"));
  Scenario agreed = circle("random", "2022");
  agreed.profile.strategies.priorities.max_levels = 2;
  EXPECT_THROW(static_cast<void>(make_controller(agreed, {1})), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::scenario::priority_values_test
