#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/search/best_first/best_first_search.hpp"
#include "planner/search/branch_and_bound/branch_and_bound.hpp"
#include "tests/support/exhaustive_search.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plan_check.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/test_automaton.hpp"

// The bounds of BranchAndBound as its kernel sees them, compared with what the best path through
// each child really costs.

namespace hlc::search {
namespace {

using test::kAllTrims;
using test::kFast;
using test::kSlow;

constexpr std::size_t kMaxSteps = 16;

/// What f may be where the best path costs `cost_m2`: its last bits hold the child's number, and
/// positions are known to some 1e-15 m.
double allowed_m2(double cost_m2) {
  return cost_m2 * (1.0 + 1e-12) + 1e-14 * std::sqrt(cost_m2) + 1e-28;
}

struct Case {
  const char* name;
  std::vector<test::LabelledSurge> labels;
  std::vector<std::size_t> trims;  ///< from 1
  std::optional<double> max_speed_mps{};
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

/// A direction of the bound, or against it, in the frame of the start.
Point random_axis(std::mt19937_64& random) {
  const double angle_rad = std::numbers::pi / 8.0 * static_cast<double>(test::pick(random, 16));
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

/// From a millimetre to 100 000 km.
double random_distance_m(std::mt19937_64& random) {
  return std::pow(10.0, test::uniform(random, -3.0, 8.0));
}

Point seen_from(const Pose& start, const Point& point_m) {
  return compose(start, {point_m.x(), point_m.y(), 0.0}).position_m();
}

/// Near the reference, all points in one place along an axis, or each anywhere; with obstacles and
/// a boundary near the start, or without.
HorizonProblem random_case(const automaton::Subgraph& subgraph, std::size_t horizon_steps,
                           std::mt19937_64& random) {
  HorizonProblem problem = test::pick(random, 2) == 0
                               ? test::random_problem(subgraph, horizon_steps, random)
                               : test::random_free_problem(subgraph, horizon_steps, random);
  problem.start_trim = subgraph.start_trims()[test::pick(random, subgraph.start_trims().size())];
  problem.avoids_steering_limit = test::pick(random, 4) == 0;
  const std::size_t kind = test::pick(random, 3);
  if (kind == 1) {
    const Point far_m = random_distance_m(random) * random_axis(random);
    problem.reference_m.assign(horizon_steps, seen_from(problem.start, far_m));
  } else if (kind == 2) {
    for (Point& reference_m : problem.reference_m) {
      reference_m =
          seen_from(problem.start, Point(random_distance_m(random) * random_axis(random)));
    }
  }
  return problem;
}

/// The best path that begins with `edge`, found by trying every path; infinite if there is none.
double cost_through(const automaton::Edge& edge, const automaton::Subgraph& subgraph,
                    const HorizonProblem& problem) {
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  const bool is_forbidden =
      problem.avoids_steering_limit &&
      automaton::is_at_steering_limit(automaton.trims[edge.to.index], automaton.vehicle,
                                      automaton.identified);
  if (is_forbidden || !test::is_free(*edge.maneuver, problem.start, 1, problem)) {
    return std::numeric_limits<double>::infinity();
  }
  HorizonProblem rest = problem;
  rest.start = compose(problem.start, edge.maneuver->displacement);
  rest.start_trim = edge.to;
  rest.reference_m.erase(rest.reference_m.begin());
  if (!rest.contouring.empty()) rest.contouring.erase(rest.contouring.begin());
  rest.reference_speed_mps.clear();
  if (!rest.obstacles_m.empty()) rest.obstacles_m.erase(rest.obstacles_m.begin());
  const auto truth = test::exhaustive_search(subgraph, rest);
  if (!truth.feasible) return std::numeric_limits<double>::infinity();
  return truth.cost + test::position_cost_m2(problem, 1, rest.start.position_m());
}

class BranchAndBoundEstimates : public testing::TestWithParam<Case> {
 protected:
  automaton::Subgraph subgraph_{
      test::make_test_subgraph(GetParam().labels, GetParam().trims, GetParam().max_speed_mps)};
  automaton::ReachableSets reachable_{subgraph_, kMaxSteps};
  BranchAndBound engine_{subgraph_, reachable_, {}};
};

TEST_P(BranchAndBoundEstimates, AreNoMoreThanTheBestPathThroughEachChildCosts) {
  std::size_t children = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(250); ++seed) {
    std::mt19937_64 random(seed);
    const HorizonProblem problem = random_case(subgraph_, 1 + test::pick(random, 4), random);
    const auto edges = subgraph_.successors(problem.start_trim);
    const std::vector<double> f = engine_.estimates(problem);
    ASSERT_EQ(f.size(), edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const double cost = cost_through(edges[i], subgraph_, problem);
      ASSERT_LE(f[i], allowed_m2(cost)) << "seed " << seed << ", child " << i;
      children += std::isfinite(cost) ? 1U : 0U;
    }
  }
  EXPECT_GE(children, 250U);
}

// A controller has tables for one step more than a replay of its decisions.
TEST_P(BranchAndBoundEstimates, AreTheSameWhateverNumberOfStepsThereAreTablesFor) {
  const automaton::ReachableSets longer(subgraph_, kMaxSteps + 1);
  BranchAndBound other(subgraph_, longer, {});
  for (std::uint64_t seed = 0; seed < test::num_seeds(100); ++seed) {
    std::mt19937_64 random(seed);
    const HorizonProblem problem = random_case(subgraph_, 1 + test::pick(random, 8), random);
    ASSERT_EQ(other.estimates(problem), engine_.estimates(problem)) << "seed " << seed;
  }
}

TEST_P(BranchAndBoundEstimates, OfTheBestChildIsNoMoreThanTheOptimumOnLongHorizons) {
  BestFirstSearch plain(subgraph_, reachable_, {.max_expansions = 20'000});
  std::size_t solved = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(60); ++seed) {
    std::mt19937_64 random(seed);
    const HorizonProblem problem = random_case(subgraph_, 5 + test::pick(random, 8), random);
    const SearchResult best = plain.search(problem, never_stop);
    if (best.status != SearchStatus::kOptimal) continue;
    ++solved;
    const std::vector<double> f = engine_.estimates(problem);
    ASSERT_LE(*std::min_element(f.begin(), f.end()), allowed_m2(best.cost)) << "seed " << seed;
  }
  EXPECT_GE(solved, 20U);
}

// Reference points beyond the places of a path that gets as far as possible along an axis: what
// counts is how far the automaton gets that way.
TEST_P(BranchAndBoundEstimates, AreTightOnReferencesBeyondWhatIsReachedAlongEveryAxis) {
  std::array<std::size_t, 16> tight{};
  for (std::size_t direction = 0; direction < tight.size(); ++direction) {
    const double angle_rad = std::numbers::pi / 8.0 * static_cast<double>(direction);
    const Point axis{std::cos(angle_rad), std::sin(angle_rad)};
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      std::mt19937_64 random(16 * seed + direction);
      HorizonProblem problem;
      problem.start = test::random_pose(random);
      problem.start_trim = subgraph_.trims()[test::pick(random, subgraph_.trims().size())];
      problem.reference_m.assign(2 + test::pick(random, 2),
                                 seen_from(problem.start, Point(1000.0 * axis)));
      const auto farthest = test::exhaustive_search(subgraph_, problem);
      const double distance_m = test::uniform(random, 0.5, 3.5);
      Pose seen;
      for (std::size_t j = 0; j < problem.reference_m.size(); ++j) {
        seen = compose(seen, farthest.maneuvers[j]->displacement);
        problem.reference_m[j] =
            seen_from(problem.start, Point(seen.position_m() + distance_m * axis));
      }
      const double optimum = test::exhaustive_search(subgraph_, problem).cost;
      const std::vector<double> f = engine_.estimates(problem);
      const double least = *std::min_element(f.begin(), f.end());
      ASSERT_LE(least, allowed_m2(optimum)) << "direction " << direction << ", seed " << seed;
      // One millimetre more in each step would be too much.
      tight[direction] += least > optimum * (1.0 - 2.0 * 1e-3 / distance_m) ? 1U : 0U;
    }
  }
  for (std::size_t direction = 0; direction < tight.size(); ++direction) {
    EXPECT_GE(tight[direction], 3U) << "direction " << direction;
  }
}

// Reference points far away along an axis: what counts is how far the automaton gets that way.
TEST_P(BranchAndBoundEstimates, AreTightOnFarReferencesAlongEveryAxis) {
  std::array<std::size_t, 16> tight{};
  for (std::size_t direction = 0; direction < tight.size(); ++direction) {
    const double angle_rad = std::numbers::pi / 8.0 * static_cast<double>(direction);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      std::mt19937_64 random(16 * seed + direction);
      HorizonProblem problem;
      problem.start = test::random_pose(random);
      problem.start_trim = subgraph_.trims()[test::pick(random, subgraph_.trims().size())];
      const double distance_m = test::uniform(random, 200.0, 400.0);
      const Point far_m{distance_m * std::cos(angle_rad), distance_m * std::sin(angle_rad)};
      problem.reference_m.assign(2 + test::pick(random, 2), seen_from(problem.start, far_m));
      const double optimum = test::exhaustive_search(subgraph_, problem).cost;
      const std::vector<double> f = engine_.estimates(problem);
      const double least = *std::min_element(f.begin(), f.end());
      ASSERT_LE(least, allowed_m2(optimum)) << "direction " << direction << ", seed " << seed;
      // One millimetre more in each step would be too much.
      tight[direction] += least > optimum * (1.0 - 2.0 * 1e-3 / 400.0) ? 1U : 0U;
    }
  }
  for (std::size_t direction = 0; direction < tight.size(); ++direction) {
    EXPECT_GE(tight[direction], 3U) << "direction " << direction;
  }
}

INSTANTIATE_TEST_SUITE_P(Automata, BranchAndBoundEstimates,
                         testing::Values(Case{"Slow", {kSlow}, kAllTrims},
                                         Case{"Fast", {kFast}, kAllTrims},
                                         Case{"Mixed", {kSlow, kFast}, {1, 2, 4, 7, 10}},
                                         Case{"SpeedLimit", {kFast, kSlow}, kAllTrims, 0.75}),
                         [](const auto& instance) { return instance.param.name; });

// Two steps with one label leave one place for each child to stop in. With the second reference
// point beside that place, along an axis, f is the cost, but for the rounding that is taken off: of
// place and interval to whole numbers (two units) and in single precision (1e-5 m, and 2^-17 of the
// distance).
TEST(BranchAndBoundEstimate, IsTheCostWhereAChildHasOnePlaceToStop) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, 2);
  BranchAndBound engine(subgraph, reachable, {});
  double longest_m = 0.0;
  for (const TrimId trim : subgraph.trims()) {
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      longest_m = std::max(longest_m, edge.maneuver->displacement.position_m().norm());
    }
  }
  const double unit_m = longest_m / 819.0;
  std::size_t checked = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(5000); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    HorizonProblem problem;
    problem.start = test::random_pose(random);
    problem.start_trim = test::random_trim(subgraph, random);
    const auto edges = subgraph.successors(problem.start_trim);
    const std::size_t i = test::pick(random, edges.size());
    const automaton::Maneuver* const last = subgraph.automaton().find(
        edges[i].to, subgraph.standstill(),
        edges[i].to == subgraph.standstill() ? automaton::kSelfLoopLabel : test::kTestLabel);
    ASSERT_NE(last, nullptr);
    const Pose seen = compose(edges[i].maneuver->displacement, last->displacement);
    const double distance_m = std::pow(10.0, test::uniform(random, -3.0, 2.6));
    const Point beside_m = distance_m * random_axis(random);
    problem.reference_m = {compose(problem.start, edges[i].maneuver->displacement).position_m(),
                           seen_from(problem.start, Point(seen.position_m() + beside_m))};
    const double f = engine.estimates(problem)[i];
    const double cost = cost_through(edges[i], subgraph, problem);
    ASSERT_LE(f, allowed_m2(cost));
    ASSERT_GE(std::sqrt(f), std::sqrt(cost) * (1.0 - 0x1p-17) - 2.0 * unit_m - 1e-5);
    ++checked;
  }
  EXPECT_GE(checked, 1000U);
}

// The second row of projections begins at horizon 10.
TEST(BranchAndBoundEstimate, IsTheSameToTheLastBitInAllKernels) {
  const automaton::Subgraph subgraph = test::make_test_subgraph({kSlow, kFast}, kAllTrims);
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  BranchAndBound best(subgraph, reachable, {});
  using Instructions = BranchAndBound::Instructions;
  BranchAndBound avx2(subgraph, reachable, {}, Instructions::kAvx2);
  BranchAndBound portable(subgraph, reachable, {}, Instructions::kPortable);
  std::size_t finite = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(1000); ++seed) {
    std::mt19937_64 random(seed);
    const HorizonProblem problem = random_case(subgraph, 1 + test::pick(random, kMaxSteps), random);
    const std::vector<double> f = best.estimates(problem);
    for (BranchAndBound* const engine : {&avx2, &portable}) {
      const std::vector<double> other = engine->estimates(problem);
      ASSERT_EQ(f.size(), other.size());
      for (std::size_t i = 0; i < f.size(); ++i) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(f[i]), std::bit_cast<std::uint64_t>(other[i]))
            << "seed " << seed << ", child " << i;
      }
    }
    finite += static_cast<std::size_t>(
        std::ranges::count_if(f, [](double value) { return std::isfinite(value); }));
  }
  EXPECT_GE(finite, 2000U);
}

}  // namespace
}  // namespace hlc::search
