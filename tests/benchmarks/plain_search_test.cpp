#include "tests/benchmarks/plain_search.hpp"

#include <gtest/gtest.h>

#include "tests/support/exhaustive_search.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plan_check.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::test::plain_search_test {
namespace {

/// The plan in the format of an engine, for `validate`.
search::SearchResult as_engine_result(const PlainResult& plan,
                                      const search::HorizonProblem& problem) {
  search::SearchResult result{.status = search::SearchStatus::kOptimal, .cost = plan.cost};
  Pose pose = problem.start;
  for (const automaton::Maneuver* maneuver : plan.maneuvers) {
    pose = compose(pose, maneuver->displacement);
    result.maneuvers.push_back(maneuver);
    result.poses.push_back(pose);
  }
  return result;
}

/// @param surge_mps2  more than 0: maneuvers outrun their trims
void expect_agreement_with_trying_every_path(double surge_mps2, std::size_t horizon_steps,
                                             std::uint64_t problems) {
  const automaton::Subgraph subgraph = make_test_subgraph(surge_mps2);
  const PlainSearch search(subgraph);
  std::uint64_t infeasible = 0;
  for (std::uint64_t seed = 0; seed < num_seeds(problems); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    search::HorizonProblem problem = random_problem(subgraph, horizon_steps, random);
    problem.contouring.clear();  // the plain search knows the paper's cost alone
    problem.avoided_in_motion_m.clear();
    problem.avoids_steering_limit = seed % 4 == 0;
    const ExhaustiveResult truth = exhaustive_search(subgraph, problem);
    const PlainResult plan = search.search(problem);
    ASSERT_EQ(plan.feasible, truth.feasible);
    if (!truth.feasible) {
      ++infeasible;
      continue;
    }
    ASSERT_NEAR(plan.cost, truth.cost, 1e-9);
    ASSERT_EQ(validate(as_engine_result(plan, problem), subgraph, problem), "");
  }
  EXPECT_GE(infeasible, 1U);
}

TEST(PlainSearch, AgreesWithTryingEveryPath) {
  expect_agreement_with_trying_every_path(0.0, 4, 200);
  expect_agreement_with_trying_every_path(0.0, 5, 60);
}

TEST(PlainSearch, AgreesWithTryingEveryPathOfManeuversThatOutrunTheirTrims) {
  expect_agreement_with_trying_every_path(8.0, 5, 60);
}

// A reference that runs ahead as fast as the car can drive makes the cost-to-go tight, but for the
// last point, which is put where the car may come to stand: a bound that is 1 % too large finds
// plans that cost more.
TEST(PlainSearch, AgreesWithTryingEveryPathWhereTheCostToGoIsTight) {
  const automaton::Subgraph subgraph = make_test_subgraph();
  const PlainSearch search(subgraph);
  for (std::uint64_t seed = 0; seed < num_seeds(300); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    search::HorizonProblem problem{.start_trim = TrimId{6}};
    const double ahead_m = uniform(random, 0.0, 1.0);
    const double beside_m = uniform(random, -0.5, 0.5);
    for (int step = 1; step < 4; ++step) {
      problem.reference_m.emplace_back(0.16 * step + ahead_m, beside_m);
    }
    problem.reference_m.emplace_back(uniform(random, 0.3, 0.6), uniform(random, -0.2, 0.2));
    const PlainResult plan = search.search(problem);
    ASSERT_TRUE(plan.feasible);
    ASSERT_NEAR(plan.cost, exhaustive_search(subgraph, problem).cost, 1e-9);
  }
}

TEST(PlainSearch, TheSameProblemGivesTheSamePlanAndCounts) {
  const automaton::Subgraph subgraph = make_test_subgraph();
  const PlainSearch search(subgraph);
  std::mt19937_64 random(1);
  const search::HorizonProblem problem = random_problem(subgraph, 8, random);
  const PlainResult first = search.search(problem);
  const PlainResult second = search.search(problem);
  EXPECT_EQ(first.cost, second.cost);
  EXPECT_EQ(first.maneuvers, second.maneuvers);
  EXPECT_EQ(first.generated, second.generated);
  EXPECT_EQ(first.expanded, second.expanded);
}

TEST(PlainSearch, ATrimThatCannotStandInTimeHasNoPlan) {
  // Of pi_7 alone with pi_1: one step from standstill.
  const automaton::Subgraph subgraph = make_test_subgraph(make_test_automaton(), {1, 7});
  const PlainResult plan = PlainSearch(subgraph).search({.start_trim = TrimId{6}});
  EXPECT_FALSE(plan.feasible);
  EXPECT_EQ(plan.generated, 1U);
  EXPECT_EQ(plan.expanded, 0U);
}

}  // namespace
}  // namespace hlc::test::plain_search_test
