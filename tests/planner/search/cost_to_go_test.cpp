#include "planner/search/cost_to_go.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "tests/support/exhaustive_search.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::search {
namespace {

using test::kAllTrims;
using test::kFast;
using test::kSlow;

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

VertexCase random_vertex(const automaton::Subgraph& subgraph, std::mt19937_64& random) {
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

/// The reference far ahead of, beside or behind a vehicle with few steps left: what counts is how
/// far the automaton gets in that direction of the start frame.
VertexCase far_reference_vertex(TrimId trim, double angle_rad, std::mt19937_64& random) {
  const std::size_t steps_left = 1 + test::pick(random, 2);
  VertexCase vertex;
  vertex.depth = test::pick(random, kMaxSteps - steps_left + 1);
  vertex.problem.start = test::random_pose(random);
  vertex.problem.start_trim = trim;
  const double distance_m = test::uniform(random, 200.0, 400.0);
  const Pose far = compose(vertex.problem.start, {distance_m * std::cos(angle_rad),
                                                  distance_m * std::sin(angle_rad), 0.0});
  vertex.problem.reference_m.assign(vertex.depth + steps_left, far.position_m());
  return vertex;
}

double cost_to_go(const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
                  const VertexCase& vertex, CostToGo kind) {
  const CostToGoFunction function(subgraph, reachable, vertex.problem, kind);
  return function(vertex.problem.start_trim, vertex.depth, to_frame(vertex.problem.start));
}

/// The bound with every reach scaled by `factor`: inadmissible if the factor is below 1.
double scaled_cost_to_go(const automaton::ReachableSets& reachable, const VertexCase& vertex,
                         double factor) {
  const HorizonProblem rest = vertex.rest();
  const std::size_t n = rest.horizon_steps();
  double h = 0.0;
  for (std::size_t i = 1; i <= n; ++i) {
    automaton::Reach reach = reachable.reach(rest.start_trim, i, n - i);
    reach.max_distance_m *= factor;
    for (double& support_m : reach.support_m) support_m *= factor;
    const Point& reference_m = rest.reference_m[i - 1];
    const Pose seen = between(rest.start, {reference_m.x(), reference_m.y(), 0.0});
    h += std::pow(distance_beyond_m(seen.position_m(), reach), 2);
  }
  return h;
}

double true_cost_to_go(const automaton::Subgraph& subgraph, const VertexCase& vertex) {
  return test::exhaustive_search(subgraph, vertex.rest()).cost;
}

constexpr std::array<CostToGo, 2> kAdmissible{CostToGo::kReachable, CostToGo::kStraightLine};

struct Automaton {
  const char* name;
  std::vector<test::LabelledSurge> labels;
  std::vector<std::size_t> trims;  ///< from 1
  std::optional<double> max_speed_mps{};
  std::vector<std::size_t> starts{};  ///< from 1; empty: those that are on
};

std::ostream& operator<<(std::ostream& out, const Automaton& a) { return out << a.name; }

class CostToGoTest : public testing::TestWithParam<Automaton> {
 protected:
  [[nodiscard]] TrimId start(std::uint64_t number) const {
    const std::vector<std::size_t>& starts =
        GetParam().starts.empty() ? GetParam().trims : GetParam().starts;
    const TrimId trim{starts[number % starts.size()] - 1};
    return subgraph_.is_enabled(trim) || !GetParam().starts.empty() ? trim : subgraph_.standstill();
  }
  /// Calls `visit(vertex, seed)` with vertices of all kinds that can still stand in time.
  template <class Visit>
  void for_vertices(std::uint64_t count, Visit visit) const {
    for (std::uint64_t seed = 0; seed < count; ++seed) {
      std::mt19937_64 random(seed);
      VertexCase vertex;
      if (seed % 3 == 0) {
        vertex = random_vertex(subgraph_, random);
        vertex.problem.start_trim = start(seed / 3);
      } else if (seed % 3 == 1) {
        vertex = full_speed_vertex(start(seed / 3), random);
      } else {
        const double angle_rad =
            std::numbers::pi / 8.0 * static_cast<double>(test::pick(random, 16));
        vertex = far_reference_vertex(start(seed / 3), angle_rad, random);
      }
      const std::size_t left = vertex.problem.horizon_steps() - vertex.depth;
      if (subgraph_.distance_to_standstill(vertex.problem.start_trim) > left) continue;
      visit(vertex, seed);
    }
  }

  automaton::Subgraph subgraph_{
      test::make_test_subgraph(GetParam().labels, GetParam().trims, GetParam().max_speed_mps)};
  automaton::ReachableSets reachable_{subgraph_, kMaxSteps};
};

TEST_P(CostToGoTest, NeverExceedsTheTrueCost) {
  for_vertices(test::num_seeds(900), [&](const VertexCase& vertex, std::uint64_t seed) {
    const double truth = true_cost_to_go(subgraph_, vertex);
    for (const CostToGo kind : kAdmissible) {
      ASSERT_LE(cost_to_go(subgraph_, reachable_, vertex, kind),
                truth + kRoundingM2 * (1.0 + truth))
          << "seed " << seed;
    }
  });
}

// So tight that it may not be 1 % larger.
TEST_P(CostToGoTest, OnePercentMoreWouldExceedTheTrueCost) {
  std::size_t violations = 0;
  for_vertices(60, [&](const VertexCase& vertex, std::uint64_t) {
    const double h = cost_to_go(subgraph_, reachable_, vertex, CostToGo::kReachable);
    violations += 1.01 * h > true_cost_to_go(subgraph_, vertex) + kRoundingM2 ? 1U : 0U;
  });
  EXPECT_GE(violations, 20U);
}

TEST_P(CostToGoTest, OnePercentLessReachWouldExceedTheTrueCost) {
  std::size_t violations = 0;
  for_vertices(60, [&](const VertexCase& vertex, std::uint64_t) {
    const double truth = true_cost_to_go(subgraph_, vertex);
    violations +=
        scaled_cost_to_go(reachable_, vertex, 0.99) > truth * (1.0 + kRoundingM2) ? 1U : 0U;
  });
  EXPECT_GE(violations, 20U);
}

TEST_P(CostToGoTest, IsNoLessThanTheStraightLineBound) {
  double sum = 0.0;
  double straight_sum = 0.0;
  for_vertices(test::num_seeds(300), [&](const VertexCase& vertex, std::uint64_t seed) {
    const double h = cost_to_go(subgraph_, reachable_, vertex, CostToGo::kReachable);
    const double straight = cost_to_go(subgraph_, reachable_, vertex, CostToGo::kStraightLine);
    ASSERT_GE(h, straight - kRoundingM2 * (1.0 + h)) << "seed " << seed;
    sum += seed % 3 == 0 ? h : 0.0;
    straight_sum += seed % 3 == 0 ? straight : 0.0;
  });
  EXPECT_GT(sum, 1.05 * straight_sum);
}

INSTANTIATE_TEST_SUITE_P(
    Automata, CostToGoTest,
    testing::Values(Automaton{"SpeedsRampLinearly", {kSlow}, kAllTrims},
                    Automaton{"ManeuversOutrunTrims", {kFast}, kAllTrims},
                    Automaton{"FewTrims", {kSlow}, {1, 4, 7, 10}},
                    Automaton{"MixedLabels", {kSlow, kFast}, {1, 2, 4, 7, 10}},
                    Automaton{"SpeedLimit", {kSlow, kFast}, kAllTrims, 0.75},
                    Automaton{"StartsThatAreOff", {kSlow}, {1, 2, 5, 8, 12}, {}, {3, 6, 7, 10}}),
    [](const auto& instance) { return instance.param.name; });

// In each of the sixteen directions, and for each trim, the support is what one step reaches.
TEST(CostToGo, IsTheTrueCostOfOneStepTowardsAFarReference) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  for (std::size_t number = 1; number <= 12; ++number) {
    for (std::size_t direction = 0; direction < 16; ++direction) {
      std::mt19937_64 random(16 * number + direction);
      VertexCase vertex = far_reference_vertex(
          {number - 1}, std::numbers::pi / 8.0 * static_cast<double>(direction), random);
      vertex.depth = vertex.problem.horizon_steps() - 1;
      const double truth = true_cost_to_go(subgraph, vertex);
      // The point reached stands aside of the line to the reference by what is lost here.
      EXPECT_NEAR(std::sqrt(cost_to_go(subgraph, reachable, vertex, CostToGo::kReachable)),
                  std::sqrt(truth), 1e-4)
          << "trim " << number << ", direction " << direction;
    }
  }
}

TEST(CostToGo, IsTheTrueCostAtFullSpeedTowardsAFarReference) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    std::mt19937_64 random(seed);
    const VertexCase vertex = full_speed_vertex(TrimId{6}, random);
    ASSERT_NEAR(cost_to_go(subgraph, reachable, vertex, CostToGo::kReachable),
                true_cost_to_go(subgraph, vertex), kRoundingM2)
        << "seed " << seed;
  }
}

TEST(StraightLineCostToGo, GoesAsFarAsTheLongestManeuverInEveryStep) {
  const automaton::Subgraph subgraph = test::make_test_subgraph({kSlow, kFast}, {1, 2, 6, 7});
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  double longest_m = 0.0;
  for (const automaton::Maneuver& maneuver : subgraph.automaton().maneuvers) {
    const auto edges = subgraph.successors(maneuver.from);
    if (std::any_of(edges.begin(), edges.end(),
                    [&](const automaton::Edge& edge) { return edge.maneuver == &maneuver; })) {
      longest_m = std::max(longest_m, maneuver.displacement.position_m().norm());
    }
  }
  ASSERT_GT(longest_m, 0.16 + 0.05);  // farther than 0.8 m/s
  HorizonProblem problem;
  problem.reference_m = {{7.0, 7.0}, {1.0, 0.0}, {0.0, 2.0}, {0.0, 0.0}};
  const CostToGoFunction function(subgraph, reachable, problem, CostToGo::kStraightLine);
  EXPECT_NEAR(function({6}, 1, Frame{}),
              std::pow(1.0 - longest_m, 2) + std::pow(2.0 - 2.0 * longest_m, 2), 1e-9);
}

TEST(DistanceBeyond, IsThatOfTheNearestHalfPlaneOrCircle) {
  automaton::Reach box{.max_distance_m = 3.0, .support_m = {}};
  box.support_m.fill(9.0);
  box.support_m[0] = box.support_m[8] = 1.0;
  box.support_m[4] = box.support_m[12] = 2.0;
  EXPECT_EQ(distance_beyond_m({0.5, -1.0}, box), 0.0);
  EXPECT_EQ(distance_beyond_m({1.5, 0.0}, box), 0.5);
  EXPECT_EQ(distance_beyond_m({0.0, -2.25}, box), 0.25);
  EXPECT_NEAR(distance_beyond_m({3.0, 4.0}, box), 2.0, 1e-15);
  EXPECT_EQ(distance_beyond_m({0.0, 7.0}, box), 5.0);
  EXPECT_EQ(distance_beyond_m({-3.5, 0.0}, box), 2.5);
}

TEST(CostToGo, IsZeroAtTheEndOfTheHorizon) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  HorizonProblem problem;
  problem.reference_m = {{1.0, 0.0}, {9.0, 9.0}};
  problem.reference_speed_mps = {0.8, 0.4};
  for (const CostToGo kind :
       {CostToGo::kReachable, CostToGo::kStraightLine, CostToGo::kReferenceSpeed}) {
    const CostToGoFunction function(subgraph, reachable, problem, kind);
    EXPECT_EQ(function(subgraph.standstill(), 2, Frame{}), 0.0);
  }
}

TEST(CostToGo2022, MarchesAtTheReferenceSpeedOfEachRemainingStep) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  HorizonProblem problem;
  problem.reference_m = {{5.0, 5.0}, {1.0, 0.0}, {0.0, 2.0}};
  problem.reference_speed_mps = {7.0, 0.8, 0.4};
  const CostToGoFunction function(subgraph, reachable, problem, CostToGo::kReferenceSpeed);
  // Steps 2 and 3 remain: reach 0.16 m and 0.16 m + 0.08 m.
  EXPECT_NEAR(function({6}, 1, Frame{}), std::pow(1.0 - 0.16, 2) + std::pow(2.0 - 0.24, 2), 1e-12);
}

TEST(CostToGo2022, IsInadmissibleWhereTheReferenceIsNear) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  VertexCase standing;
  standing.problem.start_trim = subgraph.standstill();
  standing.problem.reference_m.assign(3, Point::Zero());
  standing.problem.reference_speed_mps.assign(3, 0.8);
  EXPECT_EQ(true_cost_to_go(subgraph, standing), 0.0);
  EXPECT_GT(cost_to_go(subgraph, reachable, standing, CostToGo::kReferenceSpeed), 0.1);
  EXPECT_EQ(cost_to_go(subgraph, reachable, standing, CostToGo::kReachable), 0.0);
}

}  // namespace
}  // namespace hlc::search
