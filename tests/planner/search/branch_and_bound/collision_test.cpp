#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "planner/search/branch_and_bound/branch_and_bound.hpp"
#include "planner/search/collision.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/simple_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::search {

static void PrintTo(BranchAndBound::Instructions instructions, std::ostream* out) {
  constexpr std::array kNames{"Portable", "Avx2", "Avx512"};
  *out << kNames[static_cast<std::size_t>(instructions)];
}

namespace {

using test::box;
using test::straight_problem;

constexpr std::size_t kMaxSteps = 8;
using Instructions = BranchAndBound::Instructions;

class BranchAndBoundCollision : public testing::TestWithParam<Instructions> {
 protected:
  void SetUp() override {
    const automaton::Subgraph subgraph = test::make_test_subgraph();
    const automaton::ReachableSets reachable(subgraph, 1);
    const BranchAndBound engine(subgraph, reachable, {}, GetParam());
    if (engine.instructions() != GetParam()) GTEST_SKIP() << "this processor does not have them";
  }
};

TEST_P(BranchAndBoundCollision, AgreesWithTheCollisionCheckOnEveryEdgeOfRandomWalks) {
  const automaton::Subgraph subgraph = test::make_test_subgraph(4.0);
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  CollisionCheck check(subgraph, reachable);
  BranchAndBound engine(subgraph, reachable, {}, GetParam());
  std::size_t collisions = 0;
  std::size_t edges = 0;
  std::size_t most_corners = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(300); ++seed) {
    std::mt19937_64 random(seed);
    const HorizonProblem problem = test::random_problem(subgraph, kMaxSteps, random);
    check.prepare(problem);
    engine.prepare(problem);
    Frame frame = to_frame(problem.start);
    TrimId trim = problem.start_trim;
    for (std::size_t step = 1; step <= kMaxSteps; ++step) {
      const auto permitted = subgraph.successors(trim, kMaxSteps - step + 1);
      for (const automaton::Edge& edge : permitted) {
        const bool is_free = check.is_free(*edge.maneuver, step, frame);
        ASSERT_EQ(engine.is_free(*edge.maneuver, step, frame), is_free)
            << "seed " << seed << ", step " << step;
        collisions += is_free ? 0U : 1U;
        ++edges;
        most_corners = std::max(most_corners, edge.maneuver->swept_area_m.vertices_m.size());
      }
      const automaton::Edge& chosen = permitted[test::pick(random, permitted.size())];
      frame = compose(frame, to_frame(chosen.maneuver->displacement));
      trim = chosen.to;
    }
  }
  EXPECT_GT(most_corners, 8U) << "areas of several pieces";
  EXPECT_GT(collisions, edges / 20);
  EXPECT_LT(collisions, edges / 2);
}

/// Walks so many random steps, always able to stop at the horizon; returns the trim it ends in.
TrimId walk(const automaton::Subgraph& subgraph, TrimId trim, std::size_t steps,
            std::mt19937_64& random, Frame& frame) {
  for (std::size_t step = 1; step <= steps; ++step) {
    const auto permitted = subgraph.successors(trim, kMaxSteps - step + 1);
    const automaton::Edge& chosen = permitted[test::pick(random, permitted.size())];
    frame = compose(frame, to_frame(chosen.maneuver->displacement));
    trim = chosen.to;
  }
  return trim;
}

/// Obstacles and boundary segments 20 m away or more, in an odd number, before all others of their
/// step: what stands behind them is not where it stands in the problem.
void put_far_away(HorizonProblem& problem, std::mt19937_64& random) {
  const auto far_m = [&] {
    const double angle_rad = test::uniform(random, -4.0, 4.0);
    return Point(problem.start.position_m() + test::uniform(random, 20.0, 30.0) *
                                                  Point{std::cos(angle_rad), std::sin(angle_rad)});
  };
  for (auto& obstacles_m : problem.obstacles_m) {
    for (std::size_t count = test::pick(random, 4); count > 0; --count) {
      const Point m = far_m();
      obstacles_m.push_back(box(m.x() - 0.1, m.x() + 0.1, m.y() - 0.1, m.y() + 0.1));
    }
  }
  for (std::size_t count = 9 + 2 * test::pick(random, 8); count > 0; --count) {
    const Point m = far_m();
    problem.boundary_m.push_back({m, m + Point{0.1, 0.2}});
  }
}

// After some steps, exactly beside the vehicle, a little in, a little out: the same answers to the
// last bit, also where single precision knows less because something is 100 m long.
TEST_P(BranchAndBoundCollision, AgreesWithTheCollisionCheckWhereAreasOnlyJustTouch) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  CollisionCheck check(subgraph, reachable);
  BranchAndBound engine(subgraph, reachable, {}, GetParam());
  std::array<std::size_t, 2> answers{};
  for (std::uint64_t seed = 0; seed < test::num_seeds(4000); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    HorizonProblem problem;
    problem.start_trim = test::random_trim(subgraph, random);
    problem.reference_m.assign(kMaxSteps, Point::Zero());
    problem.obstacles_m.resize(kMaxSteps);
    if (seed % 2 == 0) problem.start = test::random_pose(random);
    const std::size_t step = 1 + test::pick(random, 7);
    Frame frame = to_frame(problem.start);
    const TrimId trim = walk(subgraph, problem.start_trim, step - 1, random, frame);
    const auto edges = subgraph.successors(trim, kMaxSteps - step + 1);
    const automaton::Maneuver& maneuver = *edges[test::pick(random, edges.size())].maneuver;
    const bool is_lane = seed % 3 == 0;
    const auto& corners = (is_lane ? maneuver.lane_area_m : maneuver.swept_area_m).vertices_m;
    const std::size_t i = test::pick(random, corners.size());
    const Point from = transformed(corners[i], frame);
    const Point to = transformed(corners[(i + 1) % corners.size()], frame);
    constexpr std::array<double, 9> kShiftsM{-1e-4, -1e-6, -1e-11, -1e-15, 0.0,
                                             1e-15, 1e-11, 1e-6,   1e-4};
    const double shift_m = kShiftsM[test::pick(random, kShiftsM.size())];
    const Point along = (to - from).normalized();
    const Point out{along.y(), -along.x()};
    const bool is_long = test::pick(random, 2) == 0;
    const Point beyond = (is_long ? test::uniform(random, 10.0, 100.0) : 0.0) * along;
    const Point a = from + shift_m * out - beyond;
    const Point b = to + shift_m * out + test::uniform(random, 0.0, 1.0) * beyond;
    if (test::pick(random, 4) != 0) put_far_away(problem, random);
    if (test::pick(random, 4) == 0) {  // only its circle is near
      const Point m = problem.start.position_m();
      problem.obstacles_m[step - 1].push_back(
          convex_hull({m + Point{100, 0}, m + Point{100, 100}, m + Point{0, 100}}));
    }
    if (is_lane) {
      for (const Segment& segment :
           {Segment{a, b}, Segment{a, a + 0.1 * out}, Segment{b + 0.05 * out, b}}) {
        problem.boundary_m.push_back(segment);
      }
    } else if (seed % 3 == 1) {  // edge to edge
      problem.obstacles_m[step - 1].push_back(convex_hull({a, b, a + 0.1 * out, b + 0.1 * out}));
    } else {  // corner to edge
      const Point corner = from + shift_m * out;
      problem.obstacles_m[step - 1].push_back(convex_hull(
          {corner, corner + 0.1 * out + 0.03 * along, corner + 0.1 * out - 0.03 * along}));
    }
    check.prepare(problem);
    engine.prepare(problem);
    const bool is_free = check.is_free(maneuver, step, frame);
    ASSERT_EQ(engine.is_free(maneuver, step, frame), is_free) << "shift " << shift_m;
    ++answers[is_free ? 1 : 0];
  }
  EXPECT_GE(answers[0], 600U);
  EXPECT_GE(answers[1], 600U);
}

TEST_P(BranchAndBoundCollision, SeesAnObstacleAtTheEdgeOfWhatCanBeReached) {
  // A preparation that leaves out what is farther than 0.99 of the reach would miss it.
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  BranchAndBound engine(subgraph, reachable, {}, GetParam());
  for (std::size_t number = 1; number <= 12; ++number) {
    const TrimId trim{number - 1};
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      // Driven along this edge and then straight on, the farthest corner in each direction.
      const Pose start{1.0, 2.0, 0.7 * static_cast<double>(number)};
      HorizonProblem problem;
      problem.start = start;
      problem.start_trim = trim;
      problem.reference_m.assign(kMaxSteps, start.position_m());
      problem.obstacles_m.resize(kMaxSteps);
      Pose pose = start;
      const automaton::Maneuver* maneuver = edge.maneuver;
      for (std::size_t step = 1; step < kMaxSteps; ++step) {
        for (const Point& corner_m : maneuver->swept_area_m.vertices_m) {
          const Point inner_m = transformed(Point(0.999 * corner_m), pose);
          problem.obstacles_m[step - 1] = {
              box(inner_m.x() - 1e-4, inner_m.x() + 1e-4, inner_m.y() - 1e-4, inner_m.y() + 1e-4)};
          engine.prepare(problem);
          ASSERT_FALSE(engine.is_free(*maneuver, step, to_frame(pose)))
              << number << " step " << step;
        }
        problem.obstacles_m[step - 1].clear();
        pose = compose(pose, maneuver->displacement);
        maneuver = subgraph.automaton().find(maneuver->to, maneuver->to, test::kTestLabel);
      }
    }
  }
}

TEST_P(BranchAndBoundCollision, ObstaclesMayHaveAnyNumberOfCorners) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  CollisionCheck check(subgraph, reachable);
  BranchAndBound engine(subgraph, reachable, {}, GetParam());
  std::array<std::size_t, 2> answers{};
  for (std::size_t corners = 3; corners <= 70; ++corners) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      std::mt19937_64 random(seed);
      HorizonProblem problem;
      problem.start = test::random_pose(random);
      problem.start_trim = TrimId{6};
      problem.reference_m.assign(kMaxSteps, problem.start.position_m());
      problem.obstacles_m.resize(kMaxSteps);
      // As large as the vehicle, or with room for it in every part.
      const double radius_m = seed % 2 == 0 ? 0.15 : 2.0;
      const double farthest_m = radius_m + 0.25;
      const Point centre_m =
          problem.start.position_m() + Point{test::uniform(random, -farthest_m, farthest_m),
                                             test::uniform(random, -farthest_m, farthest_m)};
      std::vector<Point> round_m;
      for (std::size_t i = 0; i < corners; ++i) {
        const double angle_rad =
            2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
        round_m.push_back(centre_m + radius_m * Point{std::cos(angle_rad), std::sin(angle_rad)});
      }
      problem.obstacles_m[0] = {convex_hull(std::move(round_m)), ConvexPolygon{}};
      check.prepare(problem);
      engine.prepare(problem);
      const Frame start = to_frame(problem.start);
      for (const automaton::Edge& edge : subgraph.successors(problem.start_trim)) {
        const bool is_free = check.is_free(*edge.maneuver, 1, start);
        ASSERT_EQ(engine.is_free(*edge.maneuver, 1, start), is_free)
            << corners << " corners, seed " << seed;
        ++answers[is_free ? 1 : 0];
      }
    }
  }
  EXPECT_GE(answers[0], 100U);
  EXPECT_GE(answers[1], 100U);
}

// Equal obstacles in a row are one; these share two corners of three.
TEST_P(BranchAndBoundCollision, ObstaclesThatBeginAlikeAreTwo) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  BranchAndBound engine(subgraph, reachable, {}, GetParam());
  HorizonProblem problem;
  problem.start_trim = subgraph.standstill();
  problem.reference_m.assign(kMaxSteps, Point::Zero());
  problem.obstacles_m.resize(kMaxSteps);
  const Point first{-0.3, 0.3};
  const Point second{-0.3, 0.2};
  const ConvexPolygon beside{{first, second, Point{0.3, 0.25}}};
  const ConvexPolygon across{{first, second, Point{0.3, -0.3}}};
  problem.obstacles_m[0] = {beside, beside};
  engine.prepare(problem);
  const automaton::Maneuver& standing = *subgraph.automaton().find(
      subgraph.standstill(), subgraph.standstill(), automaton::kSelfLoopLabel);
  EXPECT_TRUE(engine.is_free(standing, 1, to_frame(Pose{})));
  problem.obstacles_m[0] = {beside, across};
  engine.prepare(problem);
  EXPECT_FALSE(engine.is_free(standing, 1, to_frame(Pose{})));
}

// A tolerance that large reaches where the padding of obstacles stands.
TEST_P(BranchAndBoundCollision, AnObstacleOfAnySizeIsTheOnlyOneThatIsLookedAt) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  CollisionCheck check(subgraph, reachable);
  for (const double size_m : {1e3, 1e9, 1e15, 1e21, 1e27, 1e300}) {
    BranchAndBound engine(subgraph, reachable, {}, GetParam());  // with no memory of others
    HorizonProblem problem;
    problem.start_trim = subgraph.standstill();
    problem.reference_m.assign(kMaxSteps, Point::Zero());
    problem.obstacles_m.resize(kMaxSteps);
    problem.obstacles_m[0] = {{{Point{0.05, 0.0}, Point{size_m, 0.0}, Point{0.05, 1.0}}}};
    check.prepare(problem);
    engine.prepare(problem);
    for (const automaton::Edge& edge : subgraph.successors(problem.start_trim)) {
      ASSERT_EQ(engine.is_free(*edge.maneuver, 1, to_frame(Pose{})),
                check.is_free(*edge.maneuver, 1, to_frame(Pose{})))
          << "size " << size_m;
    }
  }
}

// Its edges are too short to have directions; what it meets the exact test knows.
TEST_P(BranchAndBoundCollision, AVehicleWithNextToNoSizeIsSeen) {
  const auto automaton =
      std::make_shared<automaton::UniversalAutomaton>(*test::make_test_automaton());
  for (automaton::Maneuver& maneuver : automaton->maneuvers) {
    for (Point& corner_m : maneuver.swept_area_m.vertices_m) corner_m *= 1e-8;
  }
  const automaton::Subgraph subgraph = test::make_test_subgraph(automaton, test::kAllTrims);
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  CollisionCheck check(subgraph, reachable);
  BranchAndBound engine(subgraph, reachable, {}, GetParam());
  HorizonProblem problem;
  problem.start_trim = subgraph.standstill();
  problem.reference_m.assign(kMaxSteps, Point::Zero());
  problem.obstacles_m.resize(kMaxSteps);
  problem.obstacles_m[0] = {
      {{Point{-0.1, -0.1}, Point{0.1, -0.1}, Point{0.1, 0.1}, Point{-0.1, 0.1}}}};
  check.prepare(problem);
  engine.prepare(problem);
  for (const automaton::Edge& edge : subgraph.successors(problem.start_trim)) {
    ASSERT_FALSE(check.is_free(*edge.maneuver, 1, to_frame(Pose{})));
    ASSERT_FALSE(engine.is_free(*edge.maneuver, 1, to_frame(Pose{})));
  }
}

// An obstacle around a vertex stops only areas that cover the vertex. Here they lie ahead of it.
TEST_P(BranchAndBoundCollision, AnObstacleAroundAVertexIsNotMetByAreasBesideIt) {
  const auto automaton =
      std::make_shared<automaton::UniversalAutomaton>(*test::make_test_automaton());
  for (automaton::Maneuver& maneuver : automaton->maneuvers) {
    for (Point& corner_m : maneuver.swept_area_m.vertices_m) corner_m += Point{0.3, 0.0};
  }
  const automaton::Subgraph subgraph = test::make_test_subgraph(automaton, test::kAllTrims);
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  CollisionCheck check(subgraph, reachable);
  BranchAndBound engine(subgraph, reachable, {}, GetParam());
  std::array<std::size_t, 2> answers{};
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    std::mt19937_64 random(seed);
    HorizonProblem problem;
    problem.start_trim = test::random_trim(subgraph, random);
    problem.reference_m.assign(kMaxSteps, Point::Zero());
    problem.obstacles_m.resize(kMaxSteps);
    std::vector<Point> corners_m;
    for (int i = 0; i < 4; ++i) {
      const double angle_rad = 0.5 * std::numbers::pi * i + test::uniform(random, 0.0, 1.5);
      corners_m.push_back(test::uniform(random, 0.1, 0.4) *
                          Point{std::cos(angle_rad), std::sin(angle_rad)});
    }
    problem.obstacles_m[0] = {convex_hull(std::move(corners_m))};
    check.prepare(problem);
    engine.prepare(problem);
    for (const automaton::Edge& edge : subgraph.successors(problem.start_trim)) {
      const bool is_free = check.is_free(*edge.maneuver, 1, to_frame(Pose{}));
      ASSERT_EQ(engine.is_free(*edge.maneuver, 1, to_frame(Pose{})), is_free) << "seed " << seed;
      ++answers[is_free ? 1 : 0];
    }
  }
  EXPECT_GE(answers[0], 50U);
  EXPECT_GE(answers[1], 50U);
}

// From a thousandth of a millimetre to kilometres, anywhere on a large map, with corners that come
// twice: single precision must know where it is not sure.
TEST_P(BranchAndBoundCollision, AgreesWithTheCollisionCheckAtAnyScale) {
  const automaton::Subgraph subgraph = test::make_test_subgraph();
  const automaton::ReachableSets reachable(subgraph, kMaxSteps);
  CollisionCheck check(subgraph, reachable);
  BranchAndBound engine(subgraph, reachable, {}, GetParam());
  std::array<std::size_t, 2> answers{};
  for (std::uint64_t seed = 0; seed < test::num_seeds(3000); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    HorizonProblem problem;
    problem.start_trim = test::random_trim(subgraph, random);
    const double map_m = std::pow(10.0, test::uniform(random, -1.0, 4.0));
    problem.start = {test::uniform(random, -map_m, map_m), test::uniform(random, -map_m, map_m),
                     test::uniform(random, -4.0, 4.0)};
    problem.reference_m.assign(kMaxSteps, problem.start.position_m());
    problem.obstacles_m.resize(kMaxSteps);
    const double size_m = std::pow(10.0, test::uniform(random, -6.0, 3.5));
    const Point near_m = problem.start.position_m() +
                         Point{test::uniform(random, -0.4, 0.4), test::uniform(random, -0.4, 0.4)};
    const Point centre_m =
        near_m + size_m * Point{test::uniform(random, -1.0, 1.0), test::uniform(random, -1.0, 1.0)};
    std::vector<Point> corners_m;
    for (std::size_t i = 0; i < 3 + test::pick(random, 9); ++i) {
      corners_m.push_back(centre_m + size_m * Point{test::uniform(random, -1.0, 1.0),
                                                    test::uniform(random, -1.0, 1.0)});
    }
    ConvexPolygon obstacle_m = convex_hull(std::move(corners_m));
    if (seed % 4 == 0) obstacle_m.vertices_m.push_back(obstacle_m.vertices_m.back());
    if (seed % 4 == 1) {  // a corner cut off by next to nothing
      obstacle_m.vertices_m.push_back(
          obstacle_m.vertices_m.back() +
          1e-9 * (obstacle_m.vertices_m.front() - obstacle_m.vertices_m.back()));
    }
    if (seed % 3 == 0) {
      for (std::size_t i = 0; i < obstacle_m.vertices_m.size(); ++i) {
        const std::size_t next = (i + 1) % obstacle_m.vertices_m.size();
        problem.boundary_m.push_back({obstacle_m.vertices_m[i], obstacle_m.vertices_m[next]});
      }
    } else {
      problem.obstacles_m[0] = {obstacle_m, obstacle_m};
    }
    check.prepare(problem);
    engine.prepare(problem);
    const Frame start = to_frame(problem.start);
    for (const automaton::Edge& edge : subgraph.successors(problem.start_trim)) {
      const bool is_free = check.is_free(*edge.maneuver, 1, start);
      ASSERT_EQ(engine.is_free(*edge.maneuver, 1, start), is_free) << "size " << size_m;
      ++answers[is_free ? 1 : 0];
    }
  }
  EXPECT_GE(answers[0], 1000U);
  EXPECT_GE(answers[1], 1000U);
}

INSTANTIATE_TEST_SUITE_P(AllKernels, BranchAndBoundCollision,
                         testing::Values(Instructions::kPortable, Instructions::kAvx2,
                                         Instructions::kAvx512),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace hlc::search
