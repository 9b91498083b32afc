#include "planner/coordination/plan_by_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::coordination {
namespace {

class PlanByIndexTest : public testing::Test {
 protected:
  const automaton::Maneuver* edge(std::size_t from, std::size_t to) const {
    return automaton_->find({from}, {to}, from == to ? "trim" : "J2");
  }
  /// From t(8) on, in force since t(7).
  [[nodiscard]] Plan plan() const {
    return Plan({7}, {1.0, 2.0, 0.5}, *edge(0, 0), automaton_)
        .continued({8}, {edge(0, 6), edge(6, 7), edge(7, 6), edge(6, 0)}, *edge(0, 0), automaton_);
  }
  std::shared_ptr<const automaton::UniversalAutomaton> automaton_{automaton::paper_automaton()};
};

void expect_same(const Plan& a, const Plan& b, StepIndex from) {
  ASSERT_EQ(std::max(a.end(), from), std::max(b.end(), from));
  for (StepIndex step = from; step.value <= std::max(a.end(), from).value + 1; ++step.value) {
    EXPECT_EQ(a.pose_at(step), b.pose_at(step)) << step.value;
    EXPECT_EQ(&a.maneuver_during(step), &b.maneuver_during(step)) << step.value;
  }
}

// The poses of a moved plan are not those that its maneuvers give from its first pose.
TEST_F(PlanByIndexTest, APlanAndWhatContinuesItAreTheSameAgainBitForBit) {
  const Plan moved = plan().moved({1.0, 2.0, 0.5}, {1.003, 2.001, 0.51});
  for (const Plan& one : {plan(), moved}) {
    const std::optional<PlanByIndex> numbers = by_index(one, {9}, *automaton_);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers->first, StepIndex{9});
    const std::optional<Plan> again = plan_of(*numbers, automaton_);
    ASSERT_TRUE(again);
    expect_same(one, *again, {9});
    const std::vector<const automaton::Maneuver*> on{edge(7, 7), edge(7, 6), edge(6, 0)};
    expect_same(one.continued({10}, on), again->continued({10}, on), {9});
  }
}

TEST_F(PlanByIndexTest, APlanThatHasRunOutStands) {
  const std::optional<PlanByIndex> numbers = by_index(plan(), {20}, *automaton_);
  ASSERT_TRUE(numbers);
  EXPECT_TRUE(numbers->maneuvers.empty());
  expect_same(plan(), *plan_of(*numbers, automaton_), {20});
}

TEST_F(PlanByIndexTest, AManeuverOfAnotherAutomatonHasNoIndex) {
  const auto other = std::make_shared<const automaton::UniversalAutomaton>(*automaton_);
  EXPECT_FALSE(by_index(plan(), {8}, *other));
}

TEST_F(PlanByIndexTest, WhatIsNoPlanIsRejected) {
  const PlanByIndex good = *by_index(plan(), {8}, *automaton_);
  ASSERT_TRUE(plan_of(good, automaton_));
  PlanByIndex beyond = good;
  beyond.maneuvers[1] = static_cast<std::uint32_t>(automaton_->maneuvers.size());
  EXPECT_FALSE(plan_of(beyond, automaton_));
  PlanByIndex broken = good;
  broken.maneuvers[1] = broken.maneuvers[0];
  EXPECT_FALSE(plan_of(broken, automaton_)) << "maneuvers do not follow each other";
  PlanByIndex driving = good;
  driving.maneuvers.pop_back();
  driving.poses.pop_back();
  EXPECT_FALSE(plan_of(driving, automaton_)) << "it does not end in the standstill";
  PlanByIndex moving = good;
  moving.standstill = moving.maneuvers[0];
  EXPECT_FALSE(plan_of(moving, automaton_)) << "no self-loop";
}

}  // namespace
}  // namespace hlc::coordination
