#include "planner/search/collision.hpp"

#include <gtest/gtest.h>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plan_check.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::search {
namespace {

constexpr std::size_t kHorizonSteps = 8;

class CollisionCheckTest : public testing::Test {
 protected:
  [[nodiscard]] const automaton::Maneuver& self_loop(TrimId trim) const {
    return *subgraph_.automaton().find(trim, trim, test::kTestLabel);
  }

  [[nodiscard]] HorizonProblem problem_from(const Pose& start, TrimId trim) const {
    HorizonProblem problem;
    problem.start = start;
    problem.start_trim = trim;
    problem.reference_m.assign(kHorizonSteps, start.position_m());
    problem.obstacles_m.resize(kHorizonSteps);
    return problem;
  }

  automaton::Subgraph subgraph_{test::make_test_subgraph(4.0)};
  automaton::ReachableSets reachable_{subgraph_, kHorizonSteps};
  CollisionCheck check_{subgraph_, reachable_};
  const TrimId straight_{6};
};

ConvexPolygon small_square(const Point& centre_m, double half_m) {
  return convex_hull({centre_m + Point{-half_m, -half_m}, centre_m + Point{half_m, -half_m},
                      centre_m + Point{half_m, half_m}, centre_m + Point{-half_m, half_m}});
}

TEST_F(CollisionCheckTest, AgreesWithPolygonByPolygonOnEveryEdgeOfRandomWalks) {
  std::size_t collisions = 0;
  std::size_t edges = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(300); ++seed) {
    std::mt19937_64 random(seed);
    const HorizonProblem problem = test::random_problem(subgraph_, kHorizonSteps, random);
    check_.prepare(problem);
    Pose pose = problem.start;
    TrimId trim = problem.start_trim;
    for (std::size_t step = 1; step <= kHorizonSteps; ++step) {
      std::vector<automaton::Edge> permitted;
      for (const automaton::Edge& edge : subgraph_.successors(trim)) {
        if (subgraph_.distance_to_standstill(edge.to) > kHorizonSteps - step) {
          continue;
        }
        permitted.push_back(edge);
        const bool is_free = test::is_free(*edge.maneuver, pose, step, problem);
        ASSERT_EQ(check_.is_free(*edge.maneuver, step, to_frame(pose)), is_free)
            << "seed " << seed << ", step " << step;
        collisions += is_free ? 0U : 1U;
        ++edges;
      }
      const automaton::Edge& chosen = permitted[test::pick(random, permitted.size())];
      pose = compose(pose, chosen.maneuver->displacement);
      trim = chosen.to;
    }
  }
  EXPECT_GT(collisions, edges / 20);
  EXPECT_LT(collisions, edges / 2);
}

TEST_F(CollisionCheckTest, SeesAnObstacleAtTheEdgeOfWhatCanBeReached) {
  // A check that leaves out what is farther than 0.99 of the reach would miss it.
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kHorizonSteps);
  CollisionCheck check(subgraph, reachable);
  const automaton::Maneuver& ahead =
      *subgraph.automaton().find(straight_, straight_, test::kTestLabel);
  const double front_m = bounding_box(ahead.swept_area_m).max_m.x();
  const double lane_front_m = bounding_box(ahead.lane_area_m).max_m.x();

  for (const double heading_rad : {0.0, 1.0, 2.5, -2.0}) {
    const Pose start{1.0, 2.0, heading_rad};
    HorizonProblem problem = problem_from(start, straight_);
    Pose last = start;
    for (std::size_t step = 1; step < kHorizonSteps; ++step) {
      const Point tip_m = transformed(Point{front_m - 1e-3, 0.0}, last);
      problem.obstacles_m[step - 1].push_back(small_square(tip_m, 1e-4));
      last = compose(last, ahead.displacement);
    }
    check.prepare(problem);
    Pose pose = start;
    for (std::size_t step = 1; step < kHorizonSteps; ++step) {
      EXPECT_FALSE(check.is_free(ahead, step, to_frame(pose))) << "step " << step;
      pose = compose(pose, ahead.displacement);
    }

    problem.obstacles_m.clear();
    const Point end_m = transformed(Point{lane_front_m - 1e-3, 0.0}, pose);
    problem.boundary_m = {{end_m, end_m + Point{1e-4, 0.0}}};
    check.prepare(problem);
    EXPECT_FALSE(check.is_free(ahead, kHorizonSteps, to_frame(pose)));
  }
}

TEST_F(CollisionCheckTest, AnObstacleCountsInItsOwnStepOnly) {
  const Pose start{1.0, 2.0, 0.3};
  HorizonProblem problem = problem_from(start, subgraph_.standstill());
  problem.obstacles_m[2] = {small_square(start.position_m(), 0.05)};
  check_.prepare(problem);
  for (std::size_t step = 1; step <= kHorizonSteps; ++step) {
    EXPECT_EQ(check_.is_free(self_loop(subgraph_.standstill()), step, to_frame(start)), step != 3);
  }
}

TEST_F(CollisionCheckTest, TheMarginKeepsObstaclesAwayButNotTheBoundary) {
  // The margin of 10 mm begins at half the width, 53.5 mm.
  const automaton::Maneuver& standing = self_loop(subgraph_.standstill());
  const auto is_free_beside = [&](double y_m, bool as_obstacle) {
    HorizonProblem problem = problem_from({}, subgraph_.standstill());
    if (as_obstacle) {
      problem.obstacles_m[0] = {convex_hull({{-0.1, y_m}, {0.1, y_m}, {0.0, y_m + 0.1}})};
    } else {
      problem.boundary_m = {{{-0.5, y_m}, {0.5, y_m}}};
    }
    check_.prepare(problem);
    return check_.is_free(standing, 1, to_frame(Pose{}));
  };
  EXPECT_FALSE(is_free_beside(0.0600, true));
  EXPECT_TRUE(is_free_beside(0.0640, true));
  EXPECT_FALSE(is_free_beside(0.0530, false));
  EXPECT_TRUE(is_free_beside(0.0600, false));
}

TEST_F(CollisionCheckTest, AllocatesNothingPerCheck) {
  std::mt19937_64 random(7);
  HorizonProblem problem = problem_from({1.0, 2.0, 0.3}, straight_);
  for (auto& obstacles : problem.obstacles_m) {
    obstacles.push_back(small_square({1.3, 2.1}, 0.05));
  }
  problem.boundary_m = {{{1.0, 1.9}, {2.0, 2.4}}, {{1.0, 1.7}, {2.0, 2.2}}};
  check_.prepare(problem);
  const Frame start = to_frame(problem.start);
  const std::size_t before = test::num_allocations();
  std::size_t free = 0;
  for (const TrimId trim : subgraph_.spec().trims) {
    for (const automaton::Edge& edge : subgraph_.successors(trim)) {
      if (check_.is_free(*edge.maneuver, 1, start)) {
        ++free;
      }
    }
  }
  EXPECT_EQ(test::num_allocations(), before);
  EXPECT_GT(before, 0);
  EXPECT_LT(free, 54);
}

}  // namespace
}  // namespace hlc::search
