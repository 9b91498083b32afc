#include "planner/joint_search/conflict_based_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>

#include "planner/joint_search/prioritized.hpp"
#include "tests/planner/joint_search/random_joint_problem.hpp"
#include "tests/support/exhaustive_joint_search.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plan_check.hpp"
#include "tests/support/simple_problem.hpp"

namespace hlc::joint_search {
namespace {

using search::NoPath;
using search::SearchStatus;

constexpr double kRounding = 1e-9;
const std::vector<std::size_t> kFewTrims{1, 3, 4, 6};

/// Every plan solves its vehicle's problem, and no two of them meet; empty if so.
std::string mistake_in(const JointPlan& plans, const JointProblem& problem,
                       const automaton::Subgraph& subgraph) {
  std::vector<std::vector<ConvexPolygon>> areas;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    const std::string fault = test::validate(plans.at(i), subgraph, problem[i].problem);
    if (!fault.empty()) return "vehicle " + std::to_string(i) + ": " + fault;
    areas.push_back(areas_of(plans[i], problem[i].problem));
    for (std::size_t k = 0; k < i; ++k) {
      for (std::size_t j = 0; j < areas[i].size(); ++j) {
        if (shared_point_m(areas[i][j], areas[k][j])) {
          return std::to_string(k) + " meets " + std::to_string(i) + " in step " +
                 std::to_string(j + 1);
        }
      }
    }
  }
  return "";
}

TEST(ConflictBasedSearch, FindsTheOptimumOfAllCombinations) {
  const JointProblems problems(kFewTrims);
  std::size_t num_conflicting = 0;
  std::size_t num_infeasible = 0;
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(400); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const std::size_t num_vehicles = 2 + seed % 2;
    const JointProblem problem = problems.draw(num_vehicles, num_vehicles == 2 ? 4 : 3, random);
    const std::optional<double> expected =
        test::exhaustive_joint_search(problems.subgraph(), problems_of(problem));
    const JointSearchResult result = search_jointly(problem);
    ASSERT_EQ(!result.plans.empty(), expected.has_value());
    if (!expected) {
      ++num_infeasible;
      EXPECT_EQ(result.status, SearchStatus::kFallback);
      EXPECT_EQ(result.reason, NoPath::kInfeasible);
      continue;
    }
    EXPECT_EQ(result.status, SearchStatus::kOptimal);
    EXPECT_NEAR(result.cost, *expected, kRounding);
    EXPECT_NEAR(result.lower_bound, *expected, kRounding + 2e-9 * *expected);
    EXPECT_NEAR(result.cost, cost_of(result.plans), kRounding);
    EXPECT_EQ(mistake_in(result.plans, problem, problems.subgraph()), "");
    if (*expected > cost_of(plan_alone(problem)) + kRounding) ++num_conflicting;
  }
  if (test::kThinning > 1) return;  // of a fifth there may be few
  EXPECT_GT(num_conflicting, 50U);
  EXPECT_GT(num_infeasible, 10U);
}

/// Searches that may stop early, in relation to the optimum.
struct StoppedSearches {
  const automaton::Subgraph& subgraph;
  std::size_t num_stopped{};
  std::size_t num_bounds{};

  void add(const JointProblem& problem, std::size_t max_expansions,
           const JointSearchResult& optimum) {
    const JointSearchResult result = search_jointly(problem, {.max_expansions = max_expansions});
    num_bounds += result.lower_bound > 0.0 ? 1U : 0U;
    num_stopped += result.status == SearchStatus::kBudget ? 1U : 0U;
    EXPECT_LE(result.lower_bound, optimum.cost * (1.0 + 2e-9));
    if (result.plans.empty()) {
      EXPECT_EQ(result.reason, NoPath::kBudget);
      return;
    }
    EXPECT_GE(result.cost, optimum.cost * (1.0 - 2e-9));
    if (result.status == SearchStatus::kOptimal) {
      EXPECT_NEAR(result.cost, optimum.cost, 2e-9 * optimum.cost);
    }
    JointPlan plans = result.plans;  // those of engines with a small budget need not be optimal
    for (search::SearchResult& plan : plans) plan.status = SearchStatus::kOptimal;
    EXPECT_EQ(mistake_in(plans, problem, subgraph), "");
  }
};

TEST(ConflictBasedSearch, BoundsTheOptimumFromBothSidesWithAnyBudget) {
  const JointProblems problems;
  const auto hurried = problems.make_engine(20);
  StoppedSearches searches{.subgraph = problems.subgraph()};
  for (std::uint64_t seed = 0; seed < test::num_seeds(60); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const JointProblem problem = problems.draw(2 + seed % 3, 5, random);
    const JointSearchResult optimum = search_jointly(problem, {.max_expansions = 200'000});
    if (optimum.status != SearchStatus::kOptimal) continue;
    JointProblem with_hurried_engines = problem;
    for (JointVehicle& one : with_hurried_engines) one.engine = hurried.get();
    for (const std::size_t max_expansions : {1U, 100U, 1000U, 10000U}) {
      searches.add(problem, max_expansions, optimum);
      searches.add(with_hurried_engines, max_expansions, optimum);
    }
  }
  EXPECT_GT(searches.num_stopped, 10U);
  EXPECT_GT(searches.num_bounds, 100U);
}

TEST(ConflictBasedSearch, IsNeverWorseThanItsIncumbent) {
  const JointProblems problems;
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(60); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const JointProblem problem = problems.draw(2 + seed % 2, 5, random);
    const JointPlan incumbent = plan_in_best_order(problem);
    if (incumbent.empty()) continue;
    const JointSearchResult hurried = search_jointly(problem, {.max_expansions = 1}, incumbent);
    EXPECT_LE(hurried.cost, cost_of(incumbent));
    const JointSearchResult with = search_jointly(problem, {}, incumbent);
    const JointSearchResult without = search_jointly(problem);
    EXPECT_EQ(with.status, SearchStatus::kOptimal);
    EXPECT_NEAR(with.cost, without.cost, 2e-9 * without.cost);
  }
}

TEST(ConflictBasedSearch, OneVehicleIsItsOwnOptimum) {
  const JointProblems problems;
  const JointProblem problem{{.problem = test::straight_problem(8), .engine = &problems.engine()}};
  const JointSearchResult result = search_jointly(problem);
  EXPECT_EQ(result.status, SearchStatus::kOptimal);
  EXPECT_EQ(result.cost, problems.engine().search(problem[0].problem).cost);
  EXPECT_EQ(result.nodes, 1U);
}

TEST(ConflictBasedSearch, AVehicleWithoutAPlanLeavesNone) {
  const JointProblems problems;
  JointProblem problem{{.problem = test::straight_problem(8), .engine = &problems.engine()},
                       {.problem = test::straight_problem(8), .engine = &problems.engine()}};
  problem[1].problem.start.y_m += 1.0;
  problem[1].problem.obstacles_m.assign(8, {test::box(0.0, 5.0, 2.5, 3.5)});
  const JointSearchResult result = search_jointly(problem);
  EXPECT_EQ(result.status, SearchStatus::kFallback);
  EXPECT_EQ(result.reason, NoPath::kInfeasible);
  EXPECT_TRUE(result.plans.empty());
}

TEST(ConflictBasedSearch, IsDeterministic) {
  const JointProblems problems;
  std::mt19937_64 random(5);
  const JointProblem problem = problems.draw(3, 6, random);
  const JointSearchResult one = search_jointly(problem);
  const JointSearchResult two = search_jointly(problem);
  EXPECT_EQ(one.cost, two.cost);
  EXPECT_EQ(one.nodes, two.nodes);
  EXPECT_EQ(one.expanded, two.expanded);
}

}  // namespace
}  // namespace hlc::joint_search
