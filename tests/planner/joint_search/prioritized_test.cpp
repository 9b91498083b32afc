#include "planner/joint_search/prioritized.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planner/joint_search/conflict_based_search.hpp"
#include "tests/planner/joint_search/random_joint_problem.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/simple_problem.hpp"

namespace hlc::joint_search {
namespace {

TEST(Prioritized, TheBestOrderIsAtMostAsDearAsAnyAndAtLeastAsDearAsTheOptimum) {
  const JointProblems problems;
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(60); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const JointProblem problem = problems.draw(3, 5, random);
    const JointPlan best = plan_in_best_order(problem);
    Order order = constant_order(3);
    do {
      const JointPlan one = plan_in_order(problem, order);
      if (one.empty()) continue;
      ASSERT_FALSE(best.empty());
      EXPECT_LE(cost_of(best), cost_of(one));
    } while (std::ranges::next_permutation(order).found);
    if (best.empty()) continue;
    const JointSearchResult optimum = search_jointly(problem);
    ASSERT_EQ(optimum.status, search::SearchStatus::kOptimal);
    EXPECT_GE(cost_of(best), optimum.cost * (1.0 - 2e-9));
    EXPECT_LE(cost_of(plan_alone(problem)), optimum.cost * (1.0 + 2e-9));
  }
}

TEST(Prioritized, TheFirstOfAnOrderDrivesItsOwnOptimum) {
  const JointProblems problems;
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(60); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const JointProblem problem = problems.draw(3, 5, random);
    const JointPlan alone = plan_alone(problem);
    const JointPlan plans = plan_in_order(problem, Order{2, 0, 1});
    if (plans.empty()) continue;
    EXPECT_EQ(plans[2].cost, alone[2].cost);
    EXPECT_GE(plans[0].cost, alone[0].cost);
    EXPECT_GE(plans[1].cost, alone[1].cost);
  }
}

/// One after the other on one line: the second one of the road meets both others, these only it.
TEST(Prioritized, WhoMeetsMostOthersIsFirst) {
  const JointProblems problems;
  JointProblem problem(3, {.problem = test::straight_problem(8), .engine = &problems.engine()});
  const auto move = [&problem](std::size_t vehicle, double by_m) {
    problem[vehicle].problem.start.x_m += by_m;
    for (Point& point_m : problem[vehicle].problem.reference_m) point_m.x() += by_m;
  };
  move(0, 0.7);  // beyond the reach of a step of vehicle 1
  move(2, 0.35);
  const JointPlan alone = plan_alone(problem);
  ASSERT_EQ(alone.size(), 3U);
  const auto areas = [&](std::size_t i) { return areas_of(alone[i], problem[i].problem); };
  ASSERT_TRUE(meet(areas(0), areas(2)) && meet(areas(1), areas(2)));
  ASSERT_FALSE(meet(areas(0), areas(1)));
  EXPECT_EQ(most_collisions_first(problem, alone), (Order{2, 0, 1}));
  EXPECT_EQ(constant_order(3), (Order{0, 1, 2}));
}

}  // namespace
}  // namespace hlc::joint_search
