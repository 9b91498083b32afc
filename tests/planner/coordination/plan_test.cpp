#include "planner/coordination/plan.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::coordination {
namespace {

class PlanTest : public testing::Test {
 protected:
  const automaton::Maneuver* edge(std::size_t from, std::size_t to) const {
    const automaton::Maneuver* found = automaton_->find({from}, {to}, from == to ? "trim" : "J2");
    EXPECT_NE(found, nullptr);
    return found;
  }

  std::shared_ptr<const automaton::UniversalAutomaton> automaton_{automaton::paper_automaton()};
};

TEST_F(PlanTest, APlanWithoutManeuversStandsForEver) {
  const Plan plan({7}, {1.0, 2.0, 0.5}, *edge(0, 0));
  EXPECT_EQ(plan.end(), StepIndex{7});
  EXPECT_EQ(plan.pose_at({1000}), (Pose{1.0, 2.0, 0.5}));
  EXPECT_EQ(plan.trim_at({7}), TrimId{0});
  EXPECT_TRUE(plan.areas_from({7}).areas_m.empty());
}

TEST_F(PlanTest, AContinuationStartsWhereThePlanIsThen) {
  const Plan standing({7}, {1.0, 2.0, 0.5}, *edge(0, 0));
  const Plan driving = standing.continued({8}, {edge(0, 6), edge(6, 6), edge(6, 0)});
  EXPECT_EQ(driving.pose_at({8}), (Pose{1.0, 2.0, 0.5}));
  EXPECT_EQ(driving.trim_at({9}), TrimId{6});
  EXPECT_EQ(driving.end(), StepIndex{11});
  EXPECT_NEAR((driving.pose_at({11}).position_m() - Point(1.0, 2.0)).norm(), 0.08 + 0.16 + 0.08,
              1e-9);

  const Plan changed = driving.continued({10}, {edge(6, 0)});
  EXPECT_EQ(changed.pose_at({10}), driving.pose_at({10}));
  EXPECT_EQ(changed.end(), StepIndex{11});
}

TEST_F(PlanTest, TheSamePlanOneStepLaterHasTheSameAreasAtTheSameTimes) {
  const Plan plan =
      Plan({7}, {1.0, 2.0, 0.5}, *edge(0, 0)).continued({8}, {edge(0, 6), edge(6, 7), edge(7, 0)});
  const OccupiedAreas now = plan.areas_from({8});
  const OccupiedAreas later = plan.areas_from({9});
  for (std::uint64_t step = 9; step < 20; ++step) {
    EXPECT_EQ(now.during({step}), later.during({step})) << step;
  }
}

TEST_F(PlanTest, ItsManeuversAreNamedUntilItStands) {
  const Plan plan =
      Plan({7}, {1.0, 2.0, 0.5}, *edge(0, 0)).continued({8}, {edge(0, 6), edge(6, 6), edge(6, 0)});
  const PlannedManeuver stands{.to = {0}, .label = automaton::kSelfLoopLabel};
  const PlannedManeuver drives{.to = {6}, .label = automaton::kSelfLoopLabel};
  const PlannedManeuver starts{.to = {6}, .label = "J2"};
  const PlannedManeuver stops{.to = {0}, .label = "J2"};
  EXPECT_EQ(plan.maneuvers_from({7}), (std::vector{stands, starts, drives, stops}));
  EXPECT_EQ(plan.maneuvers_from({10}), std::vector{stops});
  EXPECT_EQ(plan.maneuvers_from({11}), std::vector{stands});
}

TEST_F(PlanTest, ThePastIsForgottenButTheLastTwoSteps) {
  Plan plan({0}, {}, *edge(0, 0));
  plan = plan.continued({1}, {edge(0, 6), edge(6, 6), edge(6, 6), edge(6, 6), edge(6, 0)});
  const Pose at_3 = plan.pose_at({3});
  plan = plan.continued({5}, {edge(6, 0)});
  EXPECT_EQ(plan.first(), StepIndex{3});
  EXPECT_EQ(plan.pose_at({3}), at_3);
}

// An area at rest lies in the last area of the motion, so a plan that is free until it stands stays
// free.
TEST_F(PlanTest, TheFinalAreaLiesInTheLastArea) {
  for (std::size_t from = 1; from < automaton_->trims.size(); ++from) {
    const Plan plan =
        Plan({0}, {1.0, 2.0, 0.5}, *edge(0, 0)).continued({1}, {edge(0, from), edge(from, 0)});
    const OccupiedAreas areas = plan.areas_from({1});
    for (const Point& corner : areas.final_area_m.vertices_m) {
      EXPECT_TRUE(contains(areas.areas_m.back(), corner, 2e-6)) << "trim " << from + 1;
    }
  }
}

}  // namespace
}  // namespace hlc::coordination
