#include "planner/search/cost_to_go.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/exhaustive_search.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc {
namespace {

constexpr std::size_t kMaxSteps = 8;
constexpr double kRoundingM2 = 1e-9;

/// A vertex of a search tree: `depth` steps of the problem's horizon are done, and the start is
/// where the vertex is. The steps left are `steps_left()`.
struct VertexCase {
  HorizonProblem problem;
  std::size_t depth{};

  /// What is left of the problem, for the reference search.
  [[nodiscard]] HorizonProblem rest() const {
    HorizonProblem rest = problem;
    rest.reference_m.erase(rest.reference_m.begin(),
                           rest.reference_m.begin() + static_cast<std::ptrdiff_t>(depth));
    rest.reference_speed_mps.clear();
    return rest;
  }
};

VertexCase random_vertex(const Subgraph& subgraph, std::mt19937_64& random) {
  const std::size_t steps_left = 1 + test::pick(random, 4);
  const std::size_t depth = test::pick(random, kMaxSteps - steps_left + 1);
  return {test::random_free_problem(subgraph, depth + steps_left, random), depth};
}

/// Straight on at full speed with the reference far ahead: the vehicle does nothing but cover
/// distance, and the bound is tight.
VertexCase full_speed_vertex(TrimId straight, std::mt19937_64& random) {
  const std::size_t steps_left = 1 + test::pick(random, 4);
  VertexCase vertex;
  vertex.depth = test::pick(random, kMaxSteps - steps_left + 1);
  vertex.problem.start = test::random_pose(random);
  vertex.problem.start_trim = straight;
  const Pose& start = vertex.problem.start;
  for (std::size_t j = 0; j < vertex.depth + steps_left; ++j) {
    const Pose ahead = compose(start, {test::uniform(random, 2.0, 4.0), 0.0, 0.0});
    vertex.problem.reference_m.push_back(ahead.position_m());
  }
  return vertex;
}

double cost_to_go(const Subgraph& subgraph, const ReachableSets& reachable,
                  const VertexCase& vertex, CostToGo kind) {
  const CostToGoFunction function(subgraph, reachable, vertex.problem, kind);
  return function(vertex.problem.start_trim, vertex.depth, vertex.problem.start.position_m());
}

/// The bound with every reach scaled by `factor`: inadmissible if the factor is below 1.
double scaled_cost_to_go(const ReachableSets& reachable, const VertexCase& vertex, double factor) {
  const HorizonProblem rest = vertex.rest();
  const std::size_t n = rest.horizon_steps();
  std::vector<double> reach_m;
  for (std::size_t i = 1; i <= n; ++i) {
    reach_m.push_back(factor * reachable.max_distance_m(rest.start_trim, i, n - i));
  }
  return reachable_cost_to_go(rest.start.position_m(), rest.reference_m, reach_m);
}

double true_cost_to_go(const Subgraph& subgraph, const VertexCase& vertex) {
  return test::exhaustive_search(subgraph, vertex.rest()).cost;
}

struct Automaton {
  const char* name;
  double surge_mps2;
  std::vector<std::size_t> trims;  ///< from 1
};

std::ostream& operator<<(std::ostream& out, const Automaton& a) { return out << a.name; }

class CostToGoTest : public testing::TestWithParam<Automaton> {
 protected:
  Subgraph subgraph_{
      test::make_test_subgraph(test::make_test_automaton(GetParam().surge_mps2), GetParam().trims)};
  ReachableSets reachable_{subgraph_, kMaxSteps};
  const TrimId straight_{6};
};

TEST_P(CostToGoTest, NeverExceedsTheTrueCostOfRandomVertices) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(600); ++seed) {
    std::mt19937_64 random(seed);
    const VertexCase vertex = random_vertex(subgraph_, random);
    ASSERT_LE(cost_to_go(subgraph_, reachable_, vertex, CostToGo::kReachable),
              true_cost_to_go(subgraph_, vertex) + kRoundingM2)
        << "seed " << seed;
  }
}

TEST_P(CostToGoTest, NeverExceedsTheTrueCostAtFullSpeed) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(200); ++seed) {
    std::mt19937_64 random(seed);
    const VertexCase vertex = full_speed_vertex(straight_, random);
    ASSERT_LE(cost_to_go(subgraph_, reachable_, vertex, CostToGo::kReachable),
              true_cost_to_go(subgraph_, vertex) + kRoundingM2)
        << "seed " << seed;
  }
}

TEST_P(CostToGoTest, ExceedsTheTrueCostIfOnePercentOfTheReachIsMissing) {
  std::size_t violations = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    std::mt19937_64 random(seed);
    const VertexCase vertex = full_speed_vertex(straight_, random);
    if (scaled_cost_to_go(reachable_, vertex, 0.99) >
        true_cost_to_go(subgraph_, vertex) + kRoundingM2) {
      ++violations;
    }
  }
  EXPECT_GT(violations, 40);
}

INSTANTIATE_TEST_SUITE_P(
    Automata, CostToGoTest,
    testing::Values(Automaton{"SpeedsRampLinearly", 0.0, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}},
                    Automaton{"ManeuversOutrunTrims", 8.0, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}},
                    Automaton{"FewTrims", 0.0, {1, 4, 7, 10}}),
    [](const auto& instance) { return instance.param.name; });

TEST(CostToGo, IsTheTrueCostAtFullSpeedTowardsAFarReference) {
  const Subgraph subgraph = test::make_test_subgraph();
  const ReachableSets reachable(subgraph, kMaxSteps);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    std::mt19937_64 random(seed);
    const VertexCase vertex = full_speed_vertex(TrimId{6}, random);
    ASSERT_NEAR(cost_to_go(subgraph, reachable, vertex, CostToGo::kReachable),
                true_cost_to_go(subgraph, vertex), kRoundingM2)
        << "seed " << seed;
  }
}

TEST(CostToGo, IsZeroAtTheEndOfTheHorizon) {
  const Subgraph subgraph = test::make_test_subgraph();
  const ReachableSets reachable(subgraph, kMaxSteps);
  HorizonProblem problem;
  problem.reference_m = {{1.0, 0.0}, {9.0, 9.0}};
  problem.reference_speed_mps = {0.8, 0.4};
  for (const CostToGo kind : {CostToGo::kReachable, CostToGo::k2022}) {
    const CostToGoFunction function(subgraph, reachable, problem, kind);
    EXPECT_EQ(function(subgraph.standstill(), 2, {0.0, 0.0}), 0.0);
  }
}

TEST(CostToGo2022, MarchesAtTheReferenceSpeedOfEachRemainingStep) {
  const Subgraph subgraph = test::make_test_subgraph();
  const ReachableSets reachable(subgraph, kMaxSteps);
  HorizonProblem problem;
  problem.reference_m = {{5.0, 5.0}, {1.0, 0.0}, {0.0, 2.0}};
  problem.reference_speed_mps = {7.0, 0.8, 0.4};
  const CostToGoFunction function(subgraph, reachable, problem, CostToGo::k2022);
  // Steps 2 and 3 remain: reach 0.16 m and 0.16 m + 0.08 m.
  EXPECT_NEAR(function({6}, 1, {0.0, 0.0}), std::pow(1.0 - 0.16, 2) + std::pow(2.0 - 0.24, 2),
              1e-12);
}

TEST(CostToGo2022, IsInadmissibleWhereTheReferenceIsNear) {
  const Subgraph subgraph = test::make_test_subgraph();
  const ReachableSets reachable(subgraph, kMaxSteps);
  VertexCase standing;
  standing.problem.start_trim = subgraph.standstill();
  standing.problem.reference_m.assign(3, Point::Zero());
  standing.problem.reference_speed_mps.assign(3, 0.8);
  EXPECT_EQ(true_cost_to_go(subgraph, standing), 0.0);
  EXPECT_GT(cost_to_go(subgraph, reachable, standing, CostToGo::k2022), 0.1);
  EXPECT_EQ(cost_to_go(subgraph, reachable, standing, CostToGo::kReachable), 0.0);
}

}  // namespace
}  // namespace hlc
