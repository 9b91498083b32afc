#include "planner/search/edge_costs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "planner/search/best_first/best_first_search.hpp"
#include "planner/search/branch_and_bound/branch_and_bound.hpp"
#include "tests/support/exhaustive_search.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plan_check.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/same_result.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::search {
namespace {

constexpr std::size_t kMaxSteps = 6;

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Two labels, and of every maneuver a criterion of either sign and one from 0.
automaton::Subgraph make_subgraph(std::mt19937_64& random) {
  const auto automaton = test::make_test_automaton(test::paper_trims(), {test::kSlow, test::kFast});
  for (automaton::Maneuver& maneuver : automaton->maneuvers) {
    maneuver.criteria = {{"progress", uniform(random, -1.0, 0.5)},
                         {"effort", uniform(random, 0.0, 3.0)}};
  }
  automaton::SubgraphSpec spec{
      .name = "test", .labels = {test::kSlow.label, test::kFast.label}, .trims = {}};
  for (const std::size_t number : test::kAllTrims) spec.trims.push_back({number - 1});
  return {automaton, spec};
}

std::vector<PlanningWeight> random_weights(std::mt19937_64& random) {
  return {{"progress", uniform(random, 0.0, 0.1)}, {"effort", uniform(random, 0.0, 0.1)}};
}

TEST(EdgeCosts, PlansOfAllEnginesCostLeastWithTheManeuversOwnCriteria) {
  std::size_t feasible = 0;
  std::size_t other_plans = 0;
  const std::uint64_t problems = test::num_costly_seeds(150);
  for (std::uint64_t seed = 0; seed < problems; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const automaton::Subgraph subgraph = make_subgraph(random);
    const automaton::ReachableSets reachable(subgraph, kMaxSteps);
    const SearchOptions options{.criterion_weights = random_weights(random)};
    BranchAndBound fast(subgraph, reachable, options);
    BranchAndBound portable(subgraph, reachable, options, BranchAndBound::Instructions::kPortable);
    BestFirstSearch plain(subgraph, reachable, options);
    HorizonProblem problem = test::random_problem(subgraph, 1 + test::pick(random, 3), random);
    const auto truth = test::exhaustive_search(subgraph, problem, options.criterion_weights);
    const SearchResult result = fast.search(problem, never_stop);
    ASSERT_EQ(result.status == SearchStatus::kOptimal, truth.feasible);
    test::expect_same(portable.search(problem, never_stop), result);
    const SearchResult slow = plain.search(problem, never_stop);
    ASSERT_EQ(slow.status, result.status);
    if (!truth.feasible) continue;
    ++feasible;
    ASSERT_EQ(test::validate(result, subgraph, problem, options.criterion_weights), "");
    ASSERT_NEAR(result.cost, truth.cost, 1e-9);
    ASSERT_NEAR(slow.cost, truth.cost, 1e-9);
    problem.incumbent = truth.maneuvers;
    ASSERT_NEAR(fast.search(problem, never_stop).cost, truth.cost, 1e-9);
    ASSERT_NEAR(plain.search(problem, never_stop).cost, truth.cost, 1e-9);
    problem.incumbent.clear();
    other_plans +=
        test::exhaustive_search(subgraph, problem).maneuvers != truth.maneuvers ? 1U : 0U;
  }
  EXPECT_GE(feasible, problems / 3);
  EXPECT_GE(other_plans, feasible / 4) << "the criteria make a difference";
}

TEST(EdgeCosts, AtTheBudgetTheBoundIsNoMoreThanTheBestPlansCost) {
  std::size_t cut = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const automaton::Subgraph subgraph = make_subgraph(random);
    const automaton::ReachableSets reachable(subgraph, kMaxSteps);
    SearchOptions options{.criterion_weights = random_weights(random)};
    const HorizonProblem problem = test::random_problem(subgraph, kMaxSteps, random);
    BranchAndBound whole(subgraph, reachable, options);
    const SearchResult best = whole.search(problem, never_stop);
    if (best.status != SearchStatus::kOptimal) continue;
    options.max_expansions = 1 + test::pick(random, 12);
    for (const Engine engine : {Engine::kBranchAndBound, Engine::kBestFirst}) {
      options.engine = engine;
      const SearchResult result =
          make_search_engine(subgraph, reachable, options)->search(problem, never_stop);
      EXPECT_LE(result.lower_bound, best.cost + 1e-9);
      if (result.status != SearchStatus::kBudget) continue;
      EXPECT_GE(result.cost, best.cost - 1e-9);
      ++cut;
    }
  }
  EXPECT_GE(cut, 5U);
}

/// The least sum over all paths that end in an equilibrium.
double least_sum(const EdgeCosts& costs, const automaton::Subgraph& subgraph, TrimId trim,
                 std::size_t steps) {
  if (steps == 0) {
    return subgraph.automaton().trims[trim.index].is_equilibrium()
               ? 0.0
               : std::numeric_limits<double>::infinity();
  }
  double least = std::numeric_limits<double>::infinity();
  for (const automaton::Edge& edge : subgraph.successors(trim)) {
    least = std::min(
        least, costs.reduced_cost(*edge.maneuver) + least_sum(costs, subgraph, edge.to, steps - 1));
  }
  return least;
}

TEST(EdgeCosts, WhatTheRestCostsAtLeastIsExactAndNeverTooMuch) {
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(5); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const automaton::Subgraph subgraph = make_subgraph(random);
    const EdgeCosts costs(subgraph, random_weights(random), kMaxSteps);
    for (const TrimId trim : subgraph.start_trims()) {
      for (std::size_t steps = subgraph.distance_to_standstill(trim); steps <= 3; ++steps) {
        const double truth = least_sum(costs, subgraph, trim, steps);
        EXPECT_LE(costs.to_go(trim, steps), truth);
        EXPECT_NEAR(costs.to_go(trim, steps), truth, 1e-9);
      }
      for (const automaton::Edge& edge : subgraph.successors(trim)) {
        EXPECT_GE(costs.reduced_cost(*edge.maneuver), 0.0);
      }
    }
  }
}

TEST(EdgeCosts, WithoutWeightsEverythingIsZero) {
  std::mt19937_64 random(1);
  const automaton::Subgraph subgraph = make_subgraph(random);
  const EdgeCosts costs(subgraph, {}, kMaxSteps);
  EXPECT_TRUE(costs.is_zero());
  EXPECT_EQ(costs.least(), 0.0);
  EXPECT_EQ(costs.to_go(subgraph.standstill(), 3), 0.0);
}

std::string refusal_of(const std::vector<PlanningWeight>& weights) {
  std::mt19937_64 random(1);
  const automaton::Subgraph subgraph = make_subgraph(random);
  try {
    static_cast<void>(EdgeCosts(subgraph, weights, kMaxSteps));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(EdgeCosts, RefusesUnknownCriteriaAndWeightsThatAreNone) {
  EXPECT_EQ(refusal_of({{"effort", 0.0}}), "");
  EXPECT_EQ(refusal_of({{"J7", 1.0}}), "criterion_weights: J7, must be one of progress, effort");
  EXPECT_THAT(refusal_of({{"effort", -0.5}}), testing::HasSubstr("must be in 0 ... 1e9"));
  EXPECT_THAT(refusal_of({{"effort", 1.1e9}}), testing::HasSubstr("must be in 0 ... 1e9"));
  EXPECT_THAT(refusal_of({{"effort", std::numeric_limits<double>::quiet_NaN()}}),
              testing::HasSubstr("must be in 0 ..."));
}

}  // namespace
}  // namespace hlc::search
