// What both engines promise about budgets, stopping and incumbents.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/search/search_engine.hpp"
#include "tests/support/exhaustive_search.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plan_check.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::search {
namespace {

constexpr std::size_t kMaxSteps = 8;
constexpr double kRounding = 1e-9;

struct Kind {
  const char* name;
  Engine engine;
  CostToGo cost_to_go{CostToGo::kReachable};
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

class SearchBudget : public testing::TestWithParam<Kind> {
 protected:
  [[nodiscard]] std::unique_ptr<SearchEngine> engine(std::size_t max_expansions = 1'000'000) const {
    return make_search_engine(subgraph_, reachable_,
                              {.engine = GetParam().engine,
                               .cost_to_go = GetParam().cost_to_go,
                               .max_expansions = max_expansions});
  }

  /// As validate, for a path that need not be optimal.
  [[nodiscard]] std::string fault(SearchResult result, const HorizonProblem& problem) const {
    result.status = SearchStatus::kOptimal;
    return test::validate(result, subgraph_, problem);
  }

  /// Some free path that ends in standstill: the best one towards another reference.
  [[nodiscard]] std::vector<const automaton::Maneuver*> some_path(HorizonProblem problem,
                                                                  std::mt19937_64& random) const {
    problem.reference_m = test::random_reference_m(problem.start, problem.horizon_steps(), random);
    return engine()->search(problem, never_stop).maneuvers;
  }

  [[nodiscard]] double cost_of(const std::vector<const automaton::Maneuver*>& path,
                               const HorizonProblem& problem) const {
    double cost = 0.0;
    Pose pose = problem.start;
    for (std::size_t j = 0; j < path.size(); ++j) {
      pose = compose(pose, path[j]->displacement);
      cost += test::position_cost_m2(problem, j + 1, pose.position_m());
    }
    return cost;
  }

  automaton::Subgraph subgraph_{test::make_test_subgraph()};
  automaton::ReachableSets reachable_{subgraph_, kMaxSteps};
};

// From 0 expansions on: a path if one is claimed, and bounds on both sides of the optimum.
TEST_P(SearchBudget, EveryBudgetGivesAValidPathAndALowerBound) {
  std::size_t gaps = 0;
  std::size_t proven = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(30); ++seed) {
    std::mt19937_64 random(seed);
    HorizonProblem problem = test::random_problem(subgraph_, 4 + test::pick(random, 3), random);
    const SearchResult full = engine()->search(problem, never_stop);
    if (full.status != SearchStatus::kOptimal) continue;
    if (seed % 2 == 0) problem.incumbent = some_path(problem, random);
    double last_cost = 1e300;
    const SearchResult unlimited = engine()->search(problem, never_stop);
    for (std::size_t budget = 0; budget <= std::min<std::size_t>(unlimited.expanded, 60);
         ++budget) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", budget " + std::to_string(budget));
      const SearchResult result = engine(budget)->search(problem, never_stop);
      ASSERT_LE(result.expanded, budget);
      ASSERT_LE(result.lower_bound, full.cost + kRounding);
      ASSERT_GE(result.lower_bound, 0.0);
      if (result.status == SearchStatus::kFallback) {
        ASSERT_EQ(result.reason, NoPath::kBudget);
        ASSERT_EQ(result.expanded, budget);
        ASSERT_TRUE(problem.incumbent.empty());
        ASSERT_TRUE(result.maneuvers.empty() && result.poses.empty());
        continue;
      }
      ASSERT_EQ(result.reason, NoPath::kNone);
      ASSERT_EQ(fault(result, problem), "");
      ASSERT_GE(result.cost, full.cost - kRounding);
      ASSERT_LE(result.cost, last_cost + kRounding);  // more budget is never worse
      last_cost = result.cost;
      if (result.status == SearchStatus::kOptimal) {
        ++proven;
        ASSERT_EQ(result.lower_bound, result.cost);
        ASSERT_NEAR(result.cost, full.cost, kRounding);
      } else {
        ++gaps;
        ASSERT_LT(result.lower_bound, result.cost);
      }
    }
  }
  EXPECT_GE(gaps, 50U);
  EXPECT_GE(proven, 5U);
}

TEST_P(SearchBudget, TheLowerBoundGrowsWithTheBudgetFromThatOfTheStart) {
  HorizonProblem problem;
  problem.start_trim = TrimId{6};
  for (std::size_t j = 1; j <= kMaxSteps; ++j) {
    problem.reference_m.emplace_back(0.3 * static_cast<double>(j), 0.1);
  }
  const SearchResult none = engine(0)->search(problem, never_stop);
  EXPECT_EQ(none.reason, NoPath::kBudget);
  EXPECT_GT(none.lower_bound, 0.5 * engine()->search(problem, never_stop).cost);
  EXPECT_GE(engine(3)->search(problem, never_stop).lower_bound, none.lower_bound - kRounding);
}

TEST_P(SearchBudget, StopsLikeAtAUsedUpBudget) {
  std::mt19937_64 random(3);
  HorizonProblem problem = test::random_free_problem(subgraph_, kMaxSteps, random);
  problem.obstacles_m.resize(kMaxSteps);
  problem.obstacles_m.back() = {
      convex_hull({{-99.0, -99.0}, {99.0, -99.0}, {99.0, 99.0}, {-99.0, 99.0}})};
  int questions = 0;
  const SearchResult result = engine()->search(problem, [&questions] { return ++questions == 3; });
  EXPECT_EQ(result.reason, NoPath::kBudget);
  EXPECT_EQ(questions, 3);
  EXPECT_EQ(result.expanded, 128U);
  EXPECT_EQ(engine()->search(problem, [] { return true; }).expanded, 0U);

  problem.obstacles_m.clear();
  problem.incumbent = some_path(problem, random);
  const SearchResult stopped = engine()->search(problem, [] { return true; });
  EXPECT_EQ(stopped.status, SearchStatus::kBudget);
  EXPECT_EQ(stopped.maneuvers, problem.incumbent);
  EXPECT_NEAR(stopped.cost, cost_of(problem.incumbent, problem), kRounding);
  EXPECT_EQ(fault(stopped, problem), "");
}

TEST_P(SearchBudget, TheIncumbentChangesNoOptimum) {
  std::size_t worse = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    HorizonProblem problem = test::random_problem(subgraph_, 6, random);
    const SearchResult without = engine()->search(problem, never_stop);
    if (without.status != SearchStatus::kOptimal) continue;
    problem.incumbent = some_path(problem, random);
    const SearchResult with = engine()->search(problem, never_stop);
    ASSERT_EQ(with.status, SearchStatus::kOptimal);
    ASSERT_EQ(fault(with, problem), "");
    ASSERT_NEAR(with.cost, without.cost, kRounding);
    worse += cost_of(problem.incumbent, problem) > without.cost + 1e-6 ? 1U : 0U;
    if (GetParam().engine == Engine::kBestFirst) {
      ASSERT_EQ(with.expanded, without.expanded);
      ASSERT_EQ(with.generated, without.generated);
    } else {
      ASSERT_LE(with.expanded, without.expanded);
    }
    // With the best path as incumbent, that is the answer.
    problem.incumbent = without.maneuvers;
    ASSERT_NEAR(engine()->search(problem, never_stop).cost, without.cost, kRounding);
  }
  EXPECT_GE(worse, 10U);
}

TEST_P(SearchBudget, AnIncumbentThatIsNoPathOfTheProblemIsLeftOut) {
  std::mt19937_64 random(11);
  HorizonProblem problem = test::random_free_problem(subgraph_, 5, random);
  problem.start_trim = TrimId{6};
  const auto good = some_path(problem, random);
  const auto answer_with = [&](std::vector<const automaton::Maneuver*> incumbent) {
    problem.incumbent = std::move(incumbent);
    return engine(0)->search(problem, never_stop);
  };
  ASSERT_EQ(answer_with(good).maneuvers, good);

  auto shorter = good;
  shorter.pop_back();
  auto broken = good;
  broken[1] = nullptr;
  auto foreign = good;  // an equal maneuver of another automaton is none of the subgraph's edges
  const auto other = test::make_test_subgraph();
  foreign[0] = other.automaton().find(good[0]->from, good[0]->to, test::kTestLabel);
  ASSERT_NE(foreign[0], nullptr);
  const automaton::Maneuver* const straight =
      subgraph_.automaton().find({6}, {6}, test::kTestLabel);
  const std::vector<const automaton::Maneuver*> driving_on(5,
                                                           straight);  // does not stand at the end
  auto out_of_order = good;
  out_of_order[0] = subgraph_.automaton().find({0}, good[0]->to, test::kTestLabel);
  for (const auto& incumbent : {shorter, broken, foreign, driving_on, out_of_order}) {
    const SearchResult result = answer_with(incumbent);
    EXPECT_EQ(result.reason, NoPath::kBudget);
    EXPECT_TRUE(result.maneuvers.empty() && result.poses.empty());
    EXPECT_EQ(result.cost, 0.0);
  }

  const Point end_m = problem.start.position_m();
  problem.obstacles_m.resize(5);
  problem.obstacles_m[4] = {convex_hull({end_m + Point{-9.0, -9.0}, end_m + Point{9.0, -9.0},
                                         end_m + Point{9.0, 9.0}, end_m + Point{-9.0, 9.0}})};
  EXPECT_EQ(answer_with(good).status, SearchStatus::kFallback);
  problem.obstacles_m.clear();
  problem.boundary_m = {{end_m + Point{0.0, -9.0}, end_m + Point{0.0, 9.0}}};
  EXPECT_EQ(answer_with(good).status, SearchStatus::kFallback);
  problem.boundary_m.clear();

  // Through full lock to the left, near the steering limit.
  const auto step = [&](std::size_t from, std::size_t to) {
    return subgraph_.automaton().find({from - 1}, {to - 1}, test::kTestLabel);
  };
  const std::vector<const automaton::Maneuver*> locked{step(7, 1), step(1, 12), step(12, 12),
                                                       step(12, 1), step(1, 1)};
  EXPECT_EQ(answer_with(locked).maneuvers, locked);
  problem.avoids_steering_limit = true;
  EXPECT_EQ(answer_with(locked).reason, NoPath::kBudget);
}

INSTANTIATE_TEST_SUITE_P(Engines, SearchBudget,
                         testing::Values(Kind{"BranchAndBound", Engine::kBranchAndBound},
                                         Kind{"BestFirst", Engine::kBestFirst},
                                         Kind{"BestFirstStraightLine", Engine::kBestFirst,
                                              CostToGo::kStraightLine}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hlc::search
