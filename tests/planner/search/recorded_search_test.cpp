#include "planner/search/recorded_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <string>

#include "planner/search/best_first/best_first_search.hpp"
#include "tests/support/exhaustive_search.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plan_check.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/same_result.hpp"
#include "tests/support/simple_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::search {
namespace {

constexpr std::size_t kMaxSteps = 6;

/// Two labels, and of every maneuver a criterion of either sign.
automaton::Subgraph make_subgraph(std::mt19937_64& random) {
  const auto automaton = test::make_test_automaton(test::paper_trims(), {test::kSlow, test::kFast});
  for (automaton::Maneuver& maneuver : automaton->maneuvers) {
    maneuver.criteria = {{"progress", test::uniform(random, -1.0, 0.5)}};
  }
  automaton::SubgraphSpec spec{
      .name = "test", .labels = {test::kSlow.label, test::kFast.label}, .trims = {}};
  for (const std::size_t number : test::kAllTrims) spec.trims.push_back({number - 1});
  return {automaton, spec};
}

/// A random problem of up to four steps, solved and recorded.
struct Case {
  explicit Case(std::mt19937_64& random, std::uint64_t seed)
      : subgraph(make_subgraph(random)), reachable(subgraph, kMaxSteps) {
    problem = test::random_problem(subgraph, 1 + test::pick(random, 4), random);
    problem.avoids_steering_limit = seed % 4 == 0;
    if (seed % 3 == 0) options.criterion_weights = {{"progress", test::uniform(random, 0.0, 0.1)}};
    if (seed % 5 == 0) options.max_expansions = 1 + test::pick(random, 6);
    if (seed % 7 == 0) {
      problem.incumbent =
          test::exhaustive_search(subgraph, problem, options.criterion_weights).maneuvers;
    }
    recorded = record_search(subgraph, reachable, options, problem);
  }

  [[nodiscard]] bool has_plan() const { return recorded.result.status != SearchStatus::kFallback; }
  [[nodiscard]] const Frame& begin_of(const TreeVertex& vertex) const {
    return recorded.tree.vertices[vertex.parent].frame;
  }

  automaton::Subgraph subgraph;
  automaton::ReachableSets reachable;
  SearchOptions options;
  HorizonProblem problem;
  RecordedSearch recorded;
};

void for_each_case(std::uint64_t num_seeds, const std::function<void(const Case&)>& look) {
  for (std::uint64_t seed = 0; seed < num_seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    look(Case(random, seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(RecordedSearch, RecordingChangesNeitherTheResultNorItsCounts) {
  for_each_case(test::num_costly_seeds(100), [](const Case& c) {
    BestFirstSearch engine(c.subgraph, c.reachable, c.options);
    test::expect_same(c.recorded.result, engine.search(c.problem, never_stop));
  });
}

TEST(RecordedSearch, EveryVertexHasOneFateAndTheCountsAreTheEngines) {
  for_each_case(test::num_costly_seeds(100), [](const Case& c) {
    std::size_t generated = 0;
    std::array<std::size_t, kFates> fates{};
    for (const DepthCounts& depth : counts_by_depth(c.recorded.tree)) {
      ASSERT_EQ(std::accumulate(depth.fates.begin(), depth.fates.end(), std::size_t{0}),
                depth.generated);
      generated += depth.generated;
      for (std::size_t fate = 0; fate < kFates; ++fate) fates[fate] += depth.fates[fate];
    }
    const auto of = [&fates](Fate fate) { return fates[static_cast<std::size_t>(fate)]; };
    ASSERT_EQ(generated, c.recorded.result.generated);
    ASSERT_EQ(of(Fate::kExpanded), c.recorded.result.expanded);
    ASSERT_LE(of(Fate::kGoal), 1U);
    const bool stopped = c.recorded.result.status == SearchStatus::kBudget ||
                         c.recorded.result.reason == NoPath::kBudget;
    ASSERT_EQ(of(Fate::kOpen) > 0, stopped);
  });
}

TEST(RecordedSearch, OnlyExpandedVerticesHaveChildrenAndCollisionsMeetWhatTheyName) {
  std::size_t collisions = 0;
  for_each_case(test::num_costly_seeds(100), [&collisions](const Case& c) {
    const std::vector<TreeVertex>& vertices = c.recorded.tree.vertices;
    for (std::size_t id = 1; id < vertices.size(); ++id) {
      const TreeVertex& vertex = vertices[id];
      ASSERT_LT(vertex.parent, id);
      ASSERT_EQ(vertices[vertex.parent].fate, Fate::kExpanded);
      ASSERT_EQ(vertex.depth, vertices[vertex.parent].depth + 1);
      const auto met =
          obstruction_of(*vertex.maneuver, vertex.depth, c.begin_of(vertex), c.problem);
      const bool is_free = vertex.fate == Fate::kExpanded || vertex.fate == Fate::kGoal;
      const bool is_dropped = vertex.fate == Fate::kCollision;
      ASSERT_FALSE(met && is_free);
      ASSERT_FALSE(!met && is_dropped);
      collisions += is_dropped ? 1U : 0U;
    }
  });
  EXPECT_GT(collisions, 100U / test::kThinning);
}

TEST(RecordedSearch, AnObstructionIsTheFirstAreaThatIsMet) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  HorizonProblem problem = test::straight_problem(2);
  const automaton::Maneuver& first = *subgraph.successors(problem.start_trim).front().maneuver;
  const Frame start = to_frame(problem.start);
  EXPECT_EQ(obstruction_of(first, 1, start, problem), std::nullopt);
  problem.boundary_m = {{{1.05, 1.0}, {1.05, 3.0}}};
  EXPECT_EQ(obstruction_of(first, 1, start, problem), Obstruction{});
  problem.obstacles_m = {{test::box(8, 9, 8, 9), test::box(1, 2, 1, 3)}, {}};
  EXPECT_EQ(obstruction_of(first, 1, start, problem), Obstruction{1});
  EXPECT_EQ(obstruction_of(first, 2, start, problem), Obstruction{});
}

TEST(RecordedSearch, WhatIsRuledOutByTheBoundCostsNoLessThanThePlanAndWhatIsExpandedNoMore) {
  std::size_t ruled_out = 0;
  for_each_case(test::num_costly_seeds(100), [&ruled_out](const Case& c) {
    const SearchResult& result = c.recorded.result;
    for (const TreeVertex& vertex : c.recorded.tree.vertices) {
      if (vertex.fate == Fate::kBound) {
        ++ruled_out;
        ASSERT_TRUE(c.has_plan());
        ASSERT_GE(vertex.estimate_m2, result.cost);
      }
      if (vertex.fate == Fate::kOpen && c.has_plan()) {
        ASSERT_LT(vertex.estimate_m2, result.cost);
      }
      if (vertex.fate == Fate::kExpanded && result.status == SearchStatus::kOptimal) {
        ASSERT_LE(vertex.estimate_m2, result.cost + 1e-9);
      }
    }
  });
  EXPECT_GT(ruled_out, 1000U / test::kThinning);
}

TEST(RecordedSearch, ThePathOfThePlanIsInTheTreeAndItsCostIsThePlans) {
  for_each_case(test::num_costly_seeds(100), [](const Case& c) {
    if (c.recorded.result.status != SearchStatus::kOptimal || !c.problem.incumbent.empty()) return;
    const std::vector<TreeVertex>& vertices = c.recorded.tree.vertices;
    const std::vector<std::uint32_t> path =
        path_along(c.recorded.tree, c.recorded.result.maneuvers);
    ASSERT_EQ(path.size(), c.problem.horizon_steps() + 1);
    for (std::size_t j = 1; j < path.size(); ++j) {
      ASSERT_EQ(vertices[path[j]].parent, path[j - 1]);
      ASSERT_EQ(vertices[path[j]].frame.origin_m, c.recorded.result.poses[j - 1].position_m());
    }
    ASSERT_EQ(vertices[path.back()].fate, Fate::kGoal);
    ASSERT_EQ(vertices[path.back()].cost_so_far_m2, c.recorded.result.cost);
  });
}

TEST(RecordedSearch, EveryPlanIsRuledOutByExactlyOneVertex) {
  for_each_case(test::num_costly_seeds(100), [](const Case& c) {
    const PlanCounts counts = count_plans(c.recorded.tree, c.subgraph, c.problem);
    ASSERT_EQ(std::accumulate(counts.fates.begin(), counts.fates.end(), 0.0), counts.total);
    HorizonProblem open = c.problem;
    open.obstacles_m.clear();
    open.avoided_in_motion_m.clear();
    open.boundary_m.clear();
    const auto all = test::exhaustive_search(c.subgraph, open).complete_paths;
    ASSERT_EQ(counts.total, static_cast<double>(all));
  });
}

/// Least costs by first maneuver.
using CostByFirst = std::map<const automaton::Maneuver*, double>;

void expect_alternatives(const CostByFirst& truth, const std::vector<Alternative>& alternatives,
                         const SearchOptions& options, const Case& c) {
  for (const Alternative& one : alternatives) {
    ASSERT_EQ(one.best.status == SearchStatus::kOptimal, truth.contains(one.first));
    if (!truth.contains(one.first)) continue;
    ASSERT_EQ(test::validate(one.best, c.subgraph, c.problem, options.criterion_weights), "");
    ASSERT_NEAR(one.best.cost, truth.at(one.first), 1e-9);
    ASSERT_EQ(one.best.maneuvers.front(), one.first);
  }
  const Alternative* const second = runner_up(alternatives);
  ASSERT_EQ(second == nullptr, truth.empty());
  if (second == nullptr) return;
  const auto least = std::ranges::min_element(
      truth, {}, [](const auto& first_and_cost) { return first_and_cost.second; });
  ASSERT_NEAR(second->best.cost, least->second, 1e-9);
}

TEST(RecordedSearch, TheRunnerUpIsTheBestOfAllPlansWithAnotherFirstManeuver) {
  std::size_t without = 0;
  for_each_case(test::num_costly_seeds(100), [&without](const Case& c) {
    if (!c.has_plan()) return;
    SearchOptions options = c.options;
    options.max_expansions = SearchOptions{}.max_expansions;
    CostByFirst truth =
        test::exhaustive_search(c.subgraph, c.problem, options.criterion_weights).cost_by_first;
    const automaton::Maneuver* const first = c.recorded.result.maneuvers.front();
    truth.erase(first);
    for (const Engine engine : {Engine::kBestFirst, Engine::kBranchAndBound}) {
      options.engine = engine;
      expect_alternatives(
          truth, alternatives_to(first, c.subgraph, c.reachable, options, c.problem), options, c);
      if (testing::Test::HasFatalFailure()) return;
    }
    without += truth.empty() ? 1U : 0U;
  });
  EXPECT_GT(without, 0U) << "no problem without a runner-up";
}

TEST(RecordedSearch, WithoutAPlanEveryFirstManeuverIsExplained) {
  std::mt19937_64 random(1);
  const automaton::Subgraph subgraph = make_subgraph(random);
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  HorizonProblem problem = test::straight_problem(3);
  problem.obstacles_m = {{test::box(-9, 9, -9, 9)}, {}, {}};
  const RecordedSearch recorded = record_search(subgraph, reachable, {}, problem);
  EXPECT_EQ(recorded.result.reason, NoPath::kInfeasible);
  EXPECT_EQ(runner_up(recorded.alternatives), nullptr);
  ASSERT_EQ(recorded.alternatives.size(), subgraph.successors(problem.start_trim, 3).size());
  for (const Alternative& one : recorded.alternatives) {
    EXPECT_EQ(one.obstruction, Obstruction{0});
  }
}

// From pi_7 standstill is two steps away here, by way of pi_4.
TEST(RecordedSearch, AStartThatCannotStopIsTheOnlyVertex) {
  automaton::SubgraphSpec spec{.name = "test", .labels = {test::kTestLabel}, .trims = {}};
  for (const std::size_t number : {1U, 4U, 7U}) spec.trims.push_back({number - 1});
  spec.disabled_edges = {{{{6}, {0}}, std::nullopt}};
  const automaton::Subgraph subgraph(test::make_test_automaton(), spec);
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  const HorizonProblem problem = test::straight_problem(1);
  ASSERT_EQ(subgraph.distance_to_standstill(problem.start_trim), 2U);
  const RecordedSearch recorded = record_search(subgraph, reachable, {}, problem);
  ASSERT_EQ(recorded.tree.vertices.size(), 1U);
  EXPECT_EQ(recorded.tree.vertices.front().fate, Fate::kOpen);
  EXPECT_TRUE(recorded.alternatives.empty());
  EXPECT_EQ(count_plans(recorded.tree, subgraph, problem).total, 0.0);
}

TEST(RecordedSearch, WhatIsShownOfALargeTreeHoldsAllParentsAndWhatWasTakenFirst) {
  for_each_case(test::num_costly_seeds(20), [](const Case& c) {
    const std::vector<TreeVertex>& vertices = c.recorded.tree.vertices;
    ASSERT_EQ(vertices_to_show(c.recorded.tree, vertices.size()).size(), vertices.size());
    const auto taken = static_cast<std::size_t>(std::ranges::count_if(
        vertices, [](const auto& v) { return v.fate != Fate::kBound && v.fate != Fate::kOpen; }));
    for (const std::size_t most : {std::size_t{1}, std::size_t{5}, taken}) {
      const std::vector<std::uint32_t> shown = vertices_to_show(c.recorded.tree, most);
      ASSERT_EQ(shown.size(), std::min(most, vertices.size()));
      for (const std::uint32_t id : shown) {
        ASSERT_TRUE(std::ranges::binary_search(shown, vertices[id].parent));
        ASSERT_TRUE(id == 0 || most > taken || vertices[id].fate != Fate::kBound);
      }
    }
  });
}

}  // namespace
}  // namespace hlc::search
