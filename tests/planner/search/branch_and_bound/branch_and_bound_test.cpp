#include "planner/search/branch_and_bound/branch_and_bound.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/search/best_first/best_first_search.hpp"
#include "planner/search/collision.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/exhaustive_search.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plan_check.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/same_result.hpp"
#include "tests/support/simple_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::search {
namespace {

using test::box;
using test::expect_same;
using test::kAllTrims;
using test::kFast;
using test::kSlow;
using test::straight_problem;

constexpr std::size_t kMaxSteps = 8;
constexpr std::size_t kManySteps = 16;
using Instructions = BranchAndBound::Instructions;

struct Case {
  const char* name;
  std::vector<test::LabelledSurge> labels;
  std::vector<std::size_t> trims;  ///< from 1
  std::size_t horizon_steps;
  std::uint64_t problems;
  std::optional<double> max_speed_mps{};
  std::vector<std::size_t> starts{};  ///< from 1; empty: those that are on
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

automaton::Subgraph make_subgraph(const Case& param) {
  return test::make_test_subgraph(param.labels, param.trims, param.max_speed_mps);
}

/// A subgraph, what it can reach, and all engines on it.
struct Engines {
  explicit Engines(automaton::Subgraph enabled, SearchOptions options = {},
                   std::size_t max_steps = kMaxSteps)
      : subgraph(std::move(enabled)),
        reachable(subgraph, max_steps),
        fast(subgraph, reachable, options),
        avx2(subgraph, reachable, options, Instructions::kAvx2),
        portable(subgraph, reachable, options, Instructions::kPortable),
        plain(subgraph, reachable, options) {}

  automaton::Subgraph subgraph;
  automaton::ReachableSets reachable;
  BranchAndBound fast;
  BranchAndBound avx2;
  BranchAndBound portable;
  BestFirstSearch plain;
};

HorizonProblem problem_of(const Case& param, const automaton::Subgraph& subgraph,
                          std::uint64_t seed) {
  std::mt19937_64 random(seed);
  HorizonProblem problem = test::random_problem(subgraph, param.horizon_steps, random);
  problem.avoids_steering_limit = seed % 4 == 0;
  if (!param.starts.empty()) {
    problem.start_trim = {param.starts[seed % param.starts.size()] - 1};
  } else if (!subgraph.is_enabled(problem.start_trim)) {
    problem.start_trim = subgraph.standstill();
  }
  return problem;
}

class BranchAndBoundOptimality : public testing::TestWithParam<Case> {};

TEST_P(BranchAndBoundOptimality, AgreesWithBestFirstAndWithTryingEveryPath) {
  const Case& param = GetParam();
  Engines engines(make_subgraph(param));
  std::uint64_t feasible = 0;
  const std::uint64_t problems = test::num_seeds(param.problems);
  for (std::uint64_t seed = 0; seed < problems; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const HorizonProblem problem = problem_of(param, engines.subgraph, seed);
    const auto truth = test::exhaustive_search(engines.subgraph, problem);
    const SearchResult result = engines.fast.search(problem, never_stop);
    const SearchResult plain = engines.plain.search(problem, never_stop);
    ASSERT_EQ(result.status, plain.status);
    ASSERT_EQ(result.status == SearchStatus::kOptimal, truth.feasible);
    ASSERT_EQ(result.reason, truth.feasible ? NoPath::kNone : NoPath::kInfeasible);
    expect_same(engines.portable.search(problem, never_stop), result);
    if (!truth.feasible) {
      ASSERT_TRUE(result.maneuvers.empty() && result.poses.empty());
      continue;
    }
    ++feasible;
    ASSERT_EQ(test::validate(result, engines.subgraph, problem), "");
    ASSERT_NEAR(result.cost, truth.cost, 1e-9);
    ASSERT_NEAR(result.cost, plain.cost, 1e-9);
    ASSERT_EQ(result.lower_bound, result.cost);
  }
  EXPECT_GE(feasible, problems / 3);
  EXPECT_LT(feasible, problems);
}

INSTANTIATE_TEST_SUITE_P(RandomProblems, BranchAndBoundOptimality,
                         testing::Values(Case{"TwelveTrims1", {kSlow}, kAllTrims, 1, 60},
                                         Case{"TwelveTrims2", {kSlow}, kAllTrims, 2, 100},
                                         Case{"TwelveTrims3", {kSlow}, kAllTrims, 3, 200},
                                         Case{"TwelveTrims4", {kSlow}, kAllTrims, 4, 300},
                                         Case{"TwelveTrims5", {kSlow}, kAllTrims, 5, 100},
                                         Case{"FastManeuvers5", {kFast}, kAllTrims, 5, 60},
                                         Case{"FewTrims8", {kSlow}, {1, 4, 7, 10}, 8, 20},
                                         Case{"TwoLabels4", {kSlow, kFast}, kAllTrims, 4, 60},
                                         Case{
                                             "SpeedLimit4", {kFast, kSlow}, kAllTrims, 4, 60, 0.75},
                                         Case{"StartsThatAreOff5",
                                              {kSlow, kFast},
                                              {1, 2, 4, 6, 8, 10, 12},
                                              5,
                                              40,
                                              {},
                                              {3, 5, 7, 9, 11}}),
                         [](const auto& instance) { return instance.param.name; });

// Long horizons, where trying every path would take too long.
TEST(BranchAndBound, AgreesWithBestFirstOnLongHorizons) {
  Engines engines(test::make_test_subgraph());
  std::uint64_t feasible = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(150); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const HorizonProblem problem =
        test::random_problem(engines.subgraph, 6 + test::pick(random, 3), random);
    const SearchResult result = engines.fast.search(problem, never_stop);
    const SearchResult plain = engines.plain.search(problem, never_stop);
    ASSERT_EQ(result.status, plain.status);
    ASSERT_NEAR(result.cost, plain.cost, 1e-9);
    expect_same(engines.portable.search(problem, never_stop), result);
    if (result.status != SearchStatus::kOptimal) continue;
    ++feasible;
    ASSERT_EQ(test::validate(result, engines.subgraph, problem), "");
  }
  EXPECT_GE(feasible, 50U);
}

/// Searches problems of these horizons, the longest last, with all engines. Returns how many
/// best-first solved within its budget: those are compared.
std::size_t compare_horizons(const automaton::Subgraph& subgraph,
                             const std::vector<std::size_t>& horizons, std::uint64_t problems) {
  Engines engines(subgraph, {}, horizons.back());
  BestFirstSearch limited(engines.subgraph, engines.reachable, {.max_expansions = 5'000});
  std::size_t solved = 0;
  for (std::uint64_t seed = 0; seed < problems; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const HorizonProblem problem = test::random_problem(
        engines.subgraph, horizons[test::pick(random, horizons.size())], random);
    const SearchResult plain = limited.search(problem, never_stop);
    if (plain.reason == NoPath::kBudget) continue;
    const SearchResult result = engines.fast.search(problem, never_stop);
    EXPECT_EQ(result.status, plain.status);
    EXPECT_NEAR(result.cost, plain.cost, 1e-9);
    expect_same(engines.avx2.search(problem, never_stop), result);
    expect_same(engines.portable.search(problem, never_stop), result);
    if (result.status != SearchStatus::kOptimal) continue;
    ++solved;
    EXPECT_EQ(test::validate(result, engines.subgraph, problem), "");
  }
  return solved;
}

TEST(BranchAndBound, AgreesWithBestFirstOnTheLongestHorizons) {
  EXPECT_GE(compare_horizons(test::make_test_subgraph(), {9, 10, 12, 16}, test::num_seeds(80)),
            30U);
}

// Sixteen directions alone see too little of a far reference point between two of them: the search
// would expand thousands of vertices.
TEST(BranchAndBound, IsGuidedByFarReferencesAsByNearOnes) {
  Engines engines(test::make_test_subgraph(), {}, 12);
  for (std::uint64_t seed = 0; seed < test::num_seeds(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    HorizonProblem problem = straight_problem(seed % 2 == 0 ? 8 : 12);
    problem.start_trim = test::random_trim(engines.subgraph, random);
    const double angle_rad = test::uniform(random, -4.0, 4.0);
    const double distance_m = std::pow(10.0, test::uniform(random, 0.9, 5.0));
    for (Point& reference_m : problem.reference_m) {
      reference_m += distance_m * Point{std::cos(angle_rad), std::sin(angle_rad)};
    }
    const SearchResult result = engines.fast.search(problem, never_stop);
    const SearchResult plain = engines.plain.search(problem, never_stop);
    EXPECT_NEAR(result.cost, plain.cost, 1e-12 * plain.cost);
    EXPECT_LE(result.expanded, 10 * plain.expanded);
    expect_same(engines.avx2.search(problem, never_stop), result);
    expect_same(engines.portable.search(problem, never_stop), result);
  }
}

// Horizons of more than two rows of eight steps, and those whose reference points may be too far
// for whole numbers.
TEST(BranchAndBound, AgreesWithBestFirstOnHorizonsOfManyRows) {
  const automaton::Subgraph few = test::make_test_subgraph({kSlow}, {1, 6, 7, 8});
  EXPECT_GE(compare_horizons(few, {17, 18, 24, 33, 39, 40, 64}, test::num_costly_seeds(120)),
            30U / test::kThinning);
}

TEST(BranchAndBound, AgreesWithBestFirstOnAGridOfThirtyFourTrims) {
  std::vector<automaton::Trim> trims{{0.0, 0.0}};
  for (const double speed_mps : {0.3, 0.6, 0.9}) {
    for (int i = -5; i <= 5; ++i) trims.push_back({speed_mps, 0.08 * i});
  }
  automaton::SubgraphSpec spec{.name = "grid",
                               .labels = {kSlow.label},
                               .trims = {},
                               .rule = automaton::EdgeRule::kReachable};
  for (std::size_t i = 0; i < trims.size(); ++i) spec.trims.push_back({i});
  const automaton::Subgraph grid(test::make_test_automaton(trims, {kSlow}), spec);
  EXPECT_GE(compare_horizons(grid, {6, 8, 10}, test::num_costly_seeds(30)), 8U / test::kThinning);
}

// A vehicle drives to the side only to which its wheels are turned, and brakes with them so.
TEST(BranchAndBound, TurnsTheWheelsOfAStandingVehicleInTheFirstStepOnly) {
  automaton::SubgraphSpec spec{.name = "turning", .labels = {kSlow.label}, .trims = {}};
  for (std::size_t i = 0; i < 5; ++i) spec.trims.push_back({i});
  for (const TrimPair& edge : std::initializer_list<TrimPair>{
           {{0}, {2}}, {{0}, {4}}, {{2}, {3}}, {{4}, {1}}, {{1}, {4}}, {{3}, {2}}}) {
    spec.disabled_edges.push_back({.edge = edge, .label = {}});
  }
  Engines engines({test::make_test_automaton(
                       {{0.0, 0.0}, {0.0, 0.3}, {0.4, 0.3}, {0.0, -0.3}, {0.4, -0.3}}, {kSlow}),
                   spec});
  std::uint64_t turned = 0;
  const std::uint64_t problems = test::num_seeds(300);
  for (std::uint64_t seed = 0; seed < problems; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    HorizonProblem problem = test::random_problem(engines.subgraph, 6, random);
    problem.may_turn_in_place = seed % 4 != 0;
    const auto truth = test::exhaustive_search(engines.subgraph, problem);
    const SearchResult result = engines.fast.search(problem, never_stop);
    const SearchResult plain = engines.plain.search(problem, never_stop);
    ASSERT_EQ(result.status == SearchStatus::kOptimal, truth.feasible);
    expect_same(engines.portable.search(problem, never_stop), result);
    ASSERT_EQ(plain.status, result.status);
    if (!truth.feasible) continue;
    ASSERT_NEAR(result.cost, truth.cost, 1e-9);
    ASSERT_NEAR(plain.cost, truth.cost, 1e-9);
    if (turns_in_place(*result.maneuvers.front())) ++turned;
  }
  EXPECT_GE(turned, problems / 10);
}

// Also where a search ends early: its lower bound shows every bit of the children's bounds.
TEST(BranchAndBound, AllKernelsGiveTheSameBits) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kManySteps);
  std::size_t cut = 0;
  for (const std::size_t budget : {1U, 5U, 20U}) {
    BranchAndBound best(subgraph, reachable, {.max_expansions = budget});
    BranchAndBound avx2(subgraph, reachable, {.max_expansions = budget}, Instructions::kAvx2);
    BranchAndBound portable(subgraph, reachable, {.max_expansions = budget},
                            Instructions::kPortable);
    for (std::uint64_t seed = 0; seed < test::num_seeds(100); ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      std::mt19937_64 random(seed);
      const HorizonProblem problem =
          test::random_problem(subgraph, 2 + test::pick(random, kManySteps - 1), random);
      const SearchResult result = best.search(problem, never_stop);
      expect_same(avx2.search(problem, never_stop), result);
      expect_same(portable.search(problem, never_stop), result);
      cut += result.status != SearchStatus::kOptimal ? 1U : 0U;
    }
  }
  EXPECT_GE(cut, 100U);
}

TEST(BranchAndBound, TriesTheWholeTreeBeforeItSaysInfeasible) {
  // The numbers of vertices of the full tree, and of those that are no leaves, were counted
  // independently of this search.
  Engines engines(test::make_test_subgraph());
  HorizonProblem problem = straight_problem(8);
  problem.obstacles_m.resize(8);
  problem.obstacles_m.back() = {box(-99.0, 99.0, -99.0, 99.0)};
  const SearchResult result = engines.fast.search(problem, never_stop);
  EXPECT_EQ(result.reason, NoPath::kInfeasible);
  EXPECT_EQ(result.generated, 236'257);
  EXPECT_EQ(result.expanded, 130'251);
}

// Without a path for thousands of expansions the search does without costs-to-go; once there is
// one, those of the vertices on it must be theirs.
TEST(BranchAndBound, FindsTheBestPathAlsoWhereTheFirstOneComesLate) {
  Engines engines(test::make_test_subgraph());
  for (const double free_until_m : {1.3, 1.5, 1.8}) {
    for (const double aside_m : {0.0, 0.003, 0.008, -0.012}) {
      SCOPED_TRACE("free until " + std::to_string(free_until_m) + ", aside " +
                   std::to_string(aside_m));
      HorizonProblem problem = straight_problem(8);
      for (std::size_t step = 0; step < 8; ++step) {
        problem.reference_m[step].y() += aside_m * static_cast<double>(step * step);
      }
      problem.obstacles_m.resize(8);
      problem.obstacles_m.back() = {box(free_until_m, 99.0, -99.0, 99.0)};
      const SearchResult result = engines.fast.search(problem, never_stop);
      const SearchResult plain = engines.plain.search(problem, never_stop);
      ASSERT_EQ(result.status, SearchStatus::kOptimal);
      EXPECT_GT(result.expanded, 5'000U);
      EXPECT_NEAR(result.cost, plain.cost, 1e-9);
      expect_same(engines.avx2.search(problem, never_stop), result);
      expect_same(engines.portable.search(problem, never_stop), result);
    }
  }
}

TEST(BranchAndBound, WithoutHorizonStandingIsAPlanAndDrivingIsNot) {
  Engines engines(test::make_test_subgraph());
  HorizonProblem problem = straight_problem(0);
  EXPECT_EQ(engines.fast.search(problem, never_stop).reason, NoPath::kInfeasible);
  problem.start_trim = engines.subgraph.standstill();
  const SearchResult standing = engines.fast.search(problem, never_stop);
  EXPECT_EQ(standing.status, SearchStatus::kOptimal);
  EXPECT_EQ(standing.cost, 0.0);
}

TEST(BranchAndBound, RefusesBoundsThatItDoesNotHave) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  for (const CostToGo kind : {CostToGo::kStraightLine, CostToGo::kReferenceSpeed}) {
    EXPECT_THROW(static_cast<void>(make_search_engine(subgraph, reachable, {.cost_to_go = kind})),
                 std::invalid_argument);
    EXPECT_NE(
        make_search_engine(subgraph, reachable, {.engine = Engine::kBestFirst, .cost_to_go = kind}),
        nullptr);
  }
}

// With and without incumbent, to the end and to a budget, with horizons that shrink and grow.
TEST(BranchAndBound, AllocatesNothingFromTheSecondSearchOn) {
  Engines engines(test::make_test_subgraph(), {}, kManySteps);
  BranchAndBound limited(engines.subgraph, engines.reachable, {.max_expansions = 6});
  std::vector<HorizonProblem> problems;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    std::mt19937_64 random(seed);
    const std::size_t steps = seed == 0 ? 10 : 1 + test::pick(random, 10);
    problems.push_back(test::random_problem(engines.subgraph, steps, random));
    if (seed % 2 == 0) {
      problems.back().incumbent = engines.plain.search(problems.back(), never_stop).maneuvers;
    }
  }
  SearchResult result;
  const std::function<bool()> stop = never_stop;
  for (BranchAndBound* engine : {&engines.fast, &limited}) {
    for (const HorizonProblem& problem : problems) engine->search(problem, stop, result);
  }
  std::array<std::size_t, 3> seen{};
  const std::size_t before = test::num_allocations();
  for (BranchAndBound* engine : {&engines.fast, &limited}) {
    for (const HorizonProblem& problem : problems) {
      engine->search(problem, stop, result);
      ++seen[static_cast<std::size_t>(result.status)];
    }
  }
  EXPECT_EQ(test::num_allocations(), before);
  EXPECT_GT(before, 0U);
  for (const std::size_t count : seen) EXPECT_GE(count, 10U);
}

TEST(BranchAndBound, WhatWasSearchedBeforeMakesNoDifference) {
  Engines engines(test::make_test_subgraph());
  for (std::uint64_t seed = 0; seed < test::num_seeds(40); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const HorizonProblem problem =
        test::random_problem(engines.subgraph, 1 + test::pick(random, 8), random);
    const SearchResult result = engines.fast.search(problem, never_stop);
    expect_same(engines.fast.search(problem, never_stop), result);
    BranchAndBound fresh(engines.subgraph, engines.reachable, {});
    expect_same(fresh.search(problem, never_stop), result);
  }
}

}  // namespace
}  // namespace hlc::search
