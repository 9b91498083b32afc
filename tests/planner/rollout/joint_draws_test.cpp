#include "planner/rollout/joint_draws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/joint_search/prioritized.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::rollout {
namespace {

scenario::Scenario three_cars() {
  return scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml"});
}

TEST(JointDraws, VehiclesAreNearEachOtherAndTheirOptimaConflict) {
  const scenario::Scenario scenario = three_cars();
  JointDraws draws(scenario, scenario.search, 3);
  for (std::uint64_t i = 0; i < test::num_costly_seeds(30); ++i) {
    SCOPED_TRACE(i);
    const std::size_t num_vehicles = 2 + i % 3;
    const auto problem = draws.draw(num_vehicles);
    ASSERT_TRUE(problem.has_value());
    ASSERT_EQ(problem->size(), num_vehicles);
    const joint_search::JointPlan alone = joint_search::plan_alone(*problem);
    ASSERT_FALSE(alone.empty());
    for (std::size_t a = 0; a < num_vehicles; ++a) {
      const search::HorizonProblem& one = (*problem)[a].problem;
      EXPECT_LT((one.start.position_m() - problem->front().problem.start.position_m()).norm(),
                JointDraws::kNear_m);
      EXPECT_FALSE(one.reference_m.empty());
      EXPECT_FALSE(one.boundary_m.empty());
      const auto areas_a = joint_search::areas_of(alone[a], one);
      bool conflicts = false;
      for (std::size_t b = 0; b < num_vehicles; ++b) {
        if (a == b) continue;
        const auto areas_b = joint_search::areas_of(alone[b], (*problem)[b].problem);
        for (std::size_t j = 0; j < areas_a.size(); ++j) {
          conflicts = conflicts || intersects(areas_a[j], areas_b[j]);
        }
      }
      EXPECT_TRUE(conflicts) << a;
    }
  }
}

TEST(JointDraws, TheSameSeedDrawsTheSame) {
  const scenario::Scenario scenario = three_cars();
  JointDraws one(scenario, scenario.search, 7);
  JointDraws two(scenario, scenario.search, 7);
  JointDraws other(scenario, scenario.search, 8);
  const auto a = one.draw(2);
  const auto b = two.draw(2);
  const auto c = other.draw(2);
  ASSERT_TRUE(a && b && c);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ((*a)[i].problem.start, (*b)[i].problem.start);
    EXPECT_EQ((*a)[i].problem.start_trim, (*b)[i].problem.start_trim);
  }
  EXPECT_NE((*a)[0].problem.start, (*c)[0].problem.start);
}

}  // namespace
}  // namespace hlc::rollout
