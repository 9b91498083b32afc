#include "planner/search/best_first/best_first_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

HorizonProblem standing_problem(const automaton::Subgraph& subgraph, std::size_t horizon_steps) {
  HorizonProblem problem = straight_problem(horizon_steps);
  problem.start_trim = subgraph.standstill();
  return problem;
}

/// A subgraph, what it can reach, and a search on it.
struct Searcher {
  explicit Searcher(automaton::Subgraph enabled, SearchOptions options = {})
      : subgraph(std::move(enabled)),
        reachable(subgraph, kMaxSteps),
        engine(subgraph, reachable, options) {}

  [[nodiscard]] SearchResult search(const HorizonProblem& problem) {
    return engine.search(problem, never_stop);
  }

  automaton::Subgraph subgraph;
  automaton::ReachableSets reachable;
  BestFirstSearch engine;
};

struct OptimalityCase {
  const char* name;
  std::vector<test::LabelledSurge> labels;
  std::vector<std::size_t> trims;  ///< from 1
  std::size_t horizon_steps;
  std::uint64_t problems;
};

std::ostream& operator<<(std::ostream& out, const OptimalityCase& c) { return out << c.name; }

class BestFirstSearchOptimality : public testing::TestWithParam<OptimalityCase> {};

TEST_P(BestFirstSearchOptimality, AgreesWithTryingEveryPath) {
  const OptimalityCase& param = GetParam();
  Searcher searcher(test::make_test_subgraph(param.labels, param.trims));
  std::uint64_t infeasible = 0;
  std::uint64_t obstructed = 0;
  const std::uint64_t problems = test::num_seeds(param.problems);
  for (std::uint64_t seed = 0; seed < problems; ++seed) {
    std::mt19937_64 random(seed);
    HorizonProblem problem = test::random_problem(searcher.subgraph, param.horizon_steps, random);
    problem.avoids_steering_limit = seed % 4 == 0;
    const auto truth = test::exhaustive_search(searcher.subgraph, problem);
    const SearchResult result = searcher.search(problem);
    if (!truth.feasible) {
      ++infeasible;
      ASSERT_EQ(result.reason, NoPath::kInfeasible) << "seed " << seed;
      ASSERT_TRUE(result.maneuvers.empty() && result.poses.empty()) << "seed " << seed;
      continue;
    }
    ASSERT_EQ(test::validate(result, searcher.subgraph, problem), "") << "seed " << seed;
    ASSERT_NEAR(result.cost, truth.cost, 1e-9) << "seed " << seed;

    HorizonProblem open = problem;
    open.obstacles_m.clear();
    open.boundary_m.clear();
    if (searcher.search(open).cost < result.cost - 1e-6) {
      ++obstructed;
    }
  }
  // The problems must be hard enough to be informative.
  EXPECT_GE(infeasible, 1 + problems / 50);
  EXPECT_GE(obstructed, problems / 10);
}

INSTANTIATE_TEST_SUITE_P(
    RandomProblems, BestFirstSearchOptimality,
    testing::Values(OptimalityCase{"TwelveTrims4", {kSlow}, kAllTrims, 4, 300},
                    OptimalityCase{"TwelveTrims5", {kSlow}, kAllTrims, 5, 100},
                    OptimalityCase{"TwelveTrims6", {kSlow}, kAllTrims, 6, 20},
                    OptimalityCase{"FastManeuvers5", {kFast}, kAllTrims, 5, 100},
                    OptimalityCase{"FewTrims8", {kSlow}, {1, 4, 7, 10}, 8, 30},
                    OptimalityCase{"TwoLabels4", {kSlow, kFast}, kAllTrims, 4, 60},
                    OptimalityCase{"TwoLabelsOfFewTrims6", {kFast, kSlow}, {1, 4, 7, 10}, 6, 40}),
    [](const auto& instance) { return instance.param.name; });

// Both maneuvers between two trims are used: with one of the labels alone the cost is higher.
TEST(BestFirstSearch, OfTwoLabelsTheBetterIsTakenInEachStep) {
  OptimalityCase both{"Both", {kSlow, kFast}, kAllTrims, 6, 0};
  Searcher searcher(test::make_test_subgraph(both.labels, both.trims));
  automaton::SubgraphSpec one = searcher.subgraph.spec();
  one.labels = {"slow"};
  Searcher slow(
      automaton::Subgraph(test::make_test_automaton(test::paper_trims(), both.labels), one));
  one.labels = {"fast"};
  Searcher fast(
      automaton::Subgraph(test::make_test_automaton(test::paper_trims(), both.labels), one));
  std::size_t better = 0;
  const std::uint64_t problems = test::num_seeds(40);
  for (std::uint64_t seed = 0; seed < problems; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const HorizonProblem problem = test::random_free_problem(searcher.subgraph, 6, random);
    const SearchResult result = searcher.search(problem);
    ASSERT_EQ(test::validate(result, searcher.subgraph, problem), "");
    const double alone = std::min(slow.search(problem).cost, fast.search(problem).cost);
    ASSERT_LE(result.cost, alone + 1e-9);
    better += result.cost < alone - 1e-6 ? 1U : 0U;
  }
  EXPECT_GE(better, problems / 10);
}

// From a disabled trim, plans leave along its exit edges: the same as trying every path.
TEST(BestFirstSearch, FromATrimThatIsOffItAgreesWithTryingEveryPath) {
  const auto automaton = test::make_test_automaton(test::paper_trims(), {kSlow, kFast});
  automaton::SubgraphSpec spec{.name = "D", .labels = {"slow"}, .trims = {}};
  for (const std::size_t number : {1U, 2U, 4U, 6U, 8U, 10U, 12U})
    spec.trims.push_back({number - 1});
  Searcher searcher(automaton::Subgraph(automaton, spec));
  std::size_t feasible = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(60); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    HorizonProblem problem = test::random_problem(searcher.subgraph, 5, random);
    problem.start_trim = {std::vector<std::size_t>{2, 4, 6, 8, 10}.at(seed % 5)};
    ASSERT_FALSE(searcher.subgraph.is_enabled(problem.start_trim));
    const auto truth = test::exhaustive_search(searcher.subgraph, problem);
    const SearchResult result = searcher.search(problem);
    ASSERT_EQ(result.status == SearchStatus::kOptimal, truth.feasible);
    if (!truth.feasible) continue;
    ++feasible;
    ASSERT_EQ(test::validate(result, searcher.subgraph, problem), "");
    ASSERT_NEAR(result.cost, truth.cost, 1e-9);
  }
  EXPECT_GE(feasible, 20U);
}

TEST(BestFirstSearch, FromATrimWithoutAWayOutThereIsNoPath) {
  const auto automaton = test::make_test_automaton(test::paper_trims(), {kSlow});
  automaton::SubgraphSpec spec{.name = "stand", .labels = {"slow"}, .trims = {{0}}};
  for (std::size_t to = 0; to < 12; ++to) {
    if (to != 6) spec.disabled_edges.push_back({{{6}, {to}}, std::nullopt});
  }
  Searcher searcher(automaton::Subgraph(automaton, spec));
  EXPECT_EQ(searcher.search(straight_problem(8)).reason, NoPath::kInfeasible);
}

TEST(BestFirstSearch, TwoSearchesOfOneProblemAgreeInEverything) {
  Searcher first(test::make_test_subgraph());
  Searcher second(first.subgraph);
  for (std::uint64_t seed = 0; seed < test::num_seeds(30); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const HorizonProblem problem = test::random_problem(first.subgraph, 7, random);
    const SearchResult result = first.search(problem);
    expect_same(first.search(problem), result);
    expect_same(second.search(problem), result);
  }
}

TEST(BestFirstSearch, OfTwoPathsOfEqualCostTheFirstGeneratedWins) {
  // Straight on is blocked; left and right are mirror images, and right has the smaller trims.
  Searcher searcher(test::make_test_subgraph());
  for (std::size_t horizon_steps = 4; horizon_steps <= 7; ++horizon_steps) {
    for (const double half_width_m : {0.01, 0.03, 0.05, 0.07}) {
      HorizonProblem problem = straight_problem(horizon_steps);
      problem.start = {};
      for (Point& point_m : problem.reference_m) {
        point_m -= Point{1.0, 2.0};
      }
      problem.obstacles_m.assign(horizon_steps, {box(0.55, 0.65, -half_width_m, half_width_m)});
      const SearchResult result = searcher.search(problem);
      ASSERT_EQ(test::validate(result, searcher.subgraph, problem), "");
      for (const Pose& pose : result.poses) {
        EXPECT_LE(pose.y_m, 0.0);
      }
      EXPECT_LT(result.poses.back().y_m, 0.0);
    }
  }
}

TEST(BestFirstSearch, OfTwoVerticesOfEqualEstimateTheDeeperIsTakenFirst) {
  Searcher searcher(test::make_test_subgraph(test::make_test_automaton(), {1, 3, 6, 8}));
  const auto maneuver = [&](std::size_t from, std::size_t to) {
    return searcher.subgraph.automaton().find({from - 1}, {to - 1}, test::kTestLabel);
  };
  // Right turn, slower, stop. The first reference point lies as near to the left turn; the others
  // are on the path, and within reach of the left turn.
  const std::vector<const automaton::Maneuver*> path{maneuver(1, 6), maneuver(6, 3),
                                                     maneuver(3, 1)};
  HorizonProblem problem;
  problem.start_trim = searcher.subgraph.standstill();
  Frame frame = to_frame(problem.start);
  for (const automaton::Maneuver* step : path) {
    frame = compose(frame, to_frame(step->displacement));
    problem.reference_m.push_back(frame.origin_m);
  }
  problem.reference_m.front().y() = 0.0;
  const SearchResult result = searcher.search(problem);
  EXPECT_EQ(result.maneuvers, path);
  EXPECT_EQ(result.expanded, path.size());
}

TEST(BestFirstSearch, CountsTheRootAndChildrenNeverExpanded) {
  Searcher searcher(test::make_test_subgraph());
  HorizonProblem problem = straight_problem(1);  // from pi_7 only standstill is left to go to
  const SearchResult free = searcher.search(problem);
  EXPECT_EQ(free.status, SearchStatus::kOptimal);
  EXPECT_EQ(free.generated, 2);
  EXPECT_EQ(free.expanded, 1);

  problem.obstacles_m = {{box(0.0, 9.0, 0.0, 9.0)}};
  const SearchResult blocked = searcher.search(problem);
  EXPECT_EQ(blocked.reason, NoPath::kInfeasible);
  EXPECT_EQ(blocked.generated, 2);
  EXPECT_EQ(blocked.expanded, 1);
}

TEST(BestFirstSearch, TriesTheWholeTreeBeforeItSaysInfeasible) {
  // The numbers of vertices of the full tree, and of those that are no leaves, were counted
  // independently of this search.
  Searcher searcher(test::make_test_subgraph());
  HorizonProblem problem = straight_problem(8);
  problem.obstacles_m.resize(8);
  problem.obstacles_m.back() = {box(-99.0, 99.0, -99.0, 99.0)};
  const SearchResult result = searcher.search(problem);
  EXPECT_EQ(result.reason, NoPath::kInfeasible);
  EXPECT_EQ(result.generated, 236'257);
  EXPECT_EQ(result.expanded, 130'251);
}

TEST(BestFirstSearch, ExpandsFewVerticesOnAStraightReference) {
  Searcher searcher(test::make_test_subgraph());
  const SearchResult result = searcher.search(straight_problem(8));
  EXPECT_EQ(result.status, SearchStatus::kOptimal);
  EXPECT_LT(result.expanded, 1'000);  // of 130'251
}

TEST(BestFirstSearch, GivesUpAtItsBudget) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  Searcher unlimited(subgraph);
  const HorizonProblem problem = straight_problem(8);
  const SearchResult full = unlimited.search(problem);
  ASSERT_EQ(full.status, SearchStatus::kOptimal);
  ASSERT_GT(full.expanded, 1);

  Searcher enough(subgraph, {.max_expansions = full.expanded});
  expect_same(enough.search(problem), full);

  for (const std::size_t budget : {std::size_t{0}, std::size_t{1}, full.expanded - 1}) {
    Searcher limited(subgraph, {.max_expansions = budget});
    const SearchResult result = limited.search(problem);
    EXPECT_EQ(result.reason, NoPath::kBudget);
    EXPECT_EQ(result.expanded, budget);
    EXPECT_TRUE(result.maneuvers.empty());
    EXPECT_TRUE(result.poses.empty());
  }
}

TEST(BestFirstSearch, GivesUpWhenToldTo) {
  Searcher searcher(test::make_test_subgraph());
  HorizonProblem problem = straight_problem(8);
  problem.obstacles_m.resize(8);
  problem.obstacles_m.back() = {box(-99.0, 99.0, -99.0, 99.0)};
  int questions = 0;
  const SearchResult result = searcher.engine.search(problem, [&] { return ++questions == 3; });
  EXPECT_EQ(result.reason, NoPath::kBudget);
  EXPECT_EQ(questions, 3);
  EXPECT_LT(result.expanded, 1'000);
  EXPECT_EQ(searcher.engine.search(problem, [] { return true; }).expanded, 0);
}

TEST(BestFirstSearch, AVehicleThatStandsBetweenObstaclesStandsOn) {
  Searcher searcher(test::make_test_subgraph());
  HorizonProblem problem = standing_problem(searcher.subgraph, 8);
  problem.start = {1.0, 2.0, 0.0};
  // 1 mm beyond the footprint of 0.22 m x 0.107 m with its margin of 0.01 m, on all four sides.
  const double x_m = 0.12 + 0.001;
  const double y_m = 0.0635 + 0.001;
  problem.obstacles_m.assign(8, {box(1.0 + x_m, 1.5, 1.0, 3.0), box(0.5, 1.0 - x_m, 1.0, 3.0),
                                 box(0.5, 1.5, 2.0 + y_m, 3.0), box(0.5, 1.5, 1.0, 2.0 - y_m)});
  const SearchResult result = searcher.search(problem);
  ASSERT_EQ(test::validate(result, searcher.subgraph, problem), "");
  for (const Pose& pose : result.poses) {
    EXPECT_EQ(pose, problem.start);
  }
}

TEST(BestFirstSearch, HeadingRunsOnBeyondPi) {
  Searcher searcher(test::make_test_subgraph());
  HorizonProblem problem = straight_problem(8);
  problem.start = {0.0, 0.0, 3.1};
  problem.start_trim = TrimId{11};  // full lock to the left
  for (std::size_t j = 0; j < 8; ++j) {
    const double turned_rad = 3.1 + 0.3 * static_cast<double>(j);
    problem.reference_m[j] = 0.25 * Point{std::cos(turned_rad), std::sin(turned_rad)};
  }
  const SearchResult result = searcher.search(problem);
  ASSERT_EQ(test::validate(result, searcher.subgraph, problem), "");
  EXPECT_GT(result.poses.back().heading_rad, 3.2);
}

TEST(BestFirstSearch, MissingObstaclesMeanNone) {
  Searcher searcher(test::make_test_subgraph());
  HorizonProblem problem = straight_problem(6);
  problem.reference_speed_mps.clear();
  const SearchResult without = searcher.search(problem);
  EXPECT_EQ(without.status, SearchStatus::kOptimal);
  problem.obstacles_m.resize(6);
  expect_same(searcher.search(problem), without);
  problem.obstacles_m.assign(6, {ConvexPolygon{}});  // an empty polygon holds no point
  expect_same(searcher.search(problem), without);
}

TEST(BestFirstSearch, WithoutHorizonStandingIsAPlanAndDrivingIsNot) {
  Searcher searcher(test::make_test_subgraph());
  const SearchResult standing = searcher.search(standing_problem(searcher.subgraph, 0));
  EXPECT_EQ(standing.status, SearchStatus::kOptimal);
  EXPECT_EQ(standing.cost, 0.0);
  const SearchResult driving = searcher.search(straight_problem(0));
  EXPECT_EQ(driving.reason, NoPath::kInfeasible);
  EXPECT_EQ(driving.generated, 1);
}

TEST(BestFirstSearch, The2022CostToGoFindsAValidPathThatMayCostMore) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  Searcher exact(subgraph);
  Searcher authors(subgraph, {.cost_to_go = CostToGo::kReferenceSpeed});
  std::size_t suboptimal = 0;
  std::size_t bounded = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(100); ++seed) {
    std::mt19937_64 random(seed);
    const HorizonProblem problem = test::random_problem(subgraph, 6, random);
    const SearchResult best = exact.search(problem);
    const SearchResult found = authors.search(problem);
    if (best.status != SearchStatus::kOptimal) {
      ASSERT_EQ(found.status, best.status) << "seed " << seed;
      continue;
    }
    const bool is_proven = found.lower_bound == found.cost;
    ASSERT_EQ(found.status, is_proven ? SearchStatus::kOptimal : SearchStatus::kUnproven)
        << "seed " << seed;
    ASSERT_LE(found.lower_bound, best.cost) << "seed " << seed;
    if (is_proven) {
      ASSERT_EQ(found.cost, best.cost) << "seed " << seed;
    }
    ASSERT_EQ(test::validate(found, subgraph, problem), "") << "seed " << seed;
    ASSERT_GE(found.cost, best.cost - 1e-9) << "seed " << seed;
    suboptimal += found.cost > best.cost + 1e-6 ? 1U : 0U;
    bounded += found.lower_bound > 0.5 * best.cost ? 1U : 0U;
  }
  EXPECT_GT(suboptimal, 0U);
  EXPECT_GT(bounded, 0U);
}

TEST(BestFirstSearchDeathTest, SizesThatDoNotMatchAreMistakes) {
  Searcher searcher(test::make_test_subgraph());
  HorizonProblem obstacles = straight_problem(4);
  obstacles.obstacles_m.resize(3);
  EXPECT_DEATH(static_cast<void>(searcher.search(obstacles)), "is_well_formed");
  HorizonProblem speeds = straight_problem(4);
  speeds.reference_speed_mps.resize(3);
  EXPECT_DEATH(static_cast<void>(searcher.search(speeds)), "is_well_formed");
  EXPECT_DEATH(static_cast<void>(searcher.search(straight_problem(kMaxSteps + 1))),
               "is_well_formed");
}

}  // namespace
}  // namespace hlc::search
