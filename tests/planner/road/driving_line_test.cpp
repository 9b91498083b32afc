#include "planner/road/driving_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/every.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::road::driving_line_test {
namespace {

constexpr double kLane_m = 0.150;
constexpr Footprint kCar{0.220, 0.107};

/// @param turns  1: counter-clockwise, -1: clockwise
ReferencePath ring(double radius_m, double turns = 1.0) {
  std::vector<Point> points_m;
  for (int i = 0; i < 3600; ++i) {
    const double angle_rad = turns * std::numbers::pi * i / 1800.0;
    points_m.emplace_back(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad));
  }
  return {std::move(points_m), true};
}

/// The documented formula. @param kerb  side of the kerb, 1: left, -1: right
double moved_m(double kerb, double curvature_per_m) {
  return 0.372 * (kLane_m - kCar.width_m) / 2.0 +
         kerb * 0.372 * kCar.length_m * kCar.length_m / 8.0 * curvature_per_m;
}

/// That the line is `left_m` to the left everywhere.
void expect_everywhere(const DrivingLine& line, const ReferencePath& path, double left_m) {
  for (const double s_m : test::every(0.017, 0.0, path.length_m())) {
    ASSERT_NEAR(line.left_m(s_m), left_m, 2e-5) << s_m;
  }
}

std::vector<DrivingLine> lines_of(const std::vector<ReferencePath>& paths) {
  return driving_lines(paths, kLane_m, kCar);
}

TEST(DrivingLine, WithoutAnOffsetItIsThePath) {
  const ReferencePath path = ring(1.0);
  const DrivingLine line;
  for (const double s_m : test::every(0.3, -1.0, 14.0)) {
    EXPECT_EQ(line.left_m(s_m), 0.0);
    EXPECT_EQ(line.at(path, s_m), path.at(s_m));
  }
}

TEST(DrivingLine, TheOffsetIsInterpolatedAroundTheEndOfThePath) {
  const DrivingLine line({0.01, 0.02, 0.06}, 6.0);
  EXPECT_DOUBLE_EQ(line.left_m(0.0), 0.01);
  EXPECT_DOUBLE_EQ(line.left_m(1.0), 0.015);
  EXPECT_DOUBLE_EQ(line.left_m(3.0), 0.04);
  EXPECT_DOUBLE_EQ(line.left_m(5.0), 0.035) << "between the last and the first";
  EXPECT_DOUBLE_EQ(line.left_m(6.0), 0.01);
  for (std::uint64_t seed = 0; seed < test::num_seeds(100); ++seed) {
    std::mt19937_64 random(seed);
    const double s_m = std::uniform_real_distribution(0.0, 6.0)(random);
    EXPECT_NEAR(line.left_m(s_m + 12.0), line.left_m(s_m), 1e-12) << "seed " << seed;
    EXPECT_NEAR(line.left_m(s_m - 6.0), line.left_m(s_m), 1e-12) << "seed " << seed;
    EXPECT_NEAR(line.left_m(s_m + 1e-6), line.left_m(s_m), 1e-7) << "seed " << seed;
  }
  EXPECT_NEAR(line.left_m(-1e-9), 0.01, 1e-9);
}

TEST(DrivingLine, ItsPointsLieLeftOfThePath) {
  const DrivingLine line({0.02}, 2.0 * std::numbers::pi);
  for (const double s_m : test::every(0.1, 0.0, 6.3)) {
    EXPECT_NEAR(line.at(ring(1.0), s_m).norm(), 0.98, 1e-5) << "inside";
    EXPECT_NEAR(line.at(ring(1.0, -1.0), s_m).norm(), 1.02, 1e-5) << "outside";
  }
}

TEST(DrivingLine, CurvatureIsPositiveToTheLeft) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(20); ++seed) {
    std::mt19937_64 random(seed);
    const double radius_m = std::uniform_real_distribution(0.4, 3.0)(random);
    for (const double s_m : test::every(0.1, 0.0, 2.0 * std::numbers::pi * radius_m)) {
      EXPECT_NEAR(chord_curvature_per_m(ring(radius_m), s_m, 0.1) * radius_m, 1.0, 0.05)
          << "seed " << seed << ", also where the heading jumps by a turn: " << s_m;
      EXPECT_NEAR(chord_curvature_per_m(ring(radius_m, -1.0), s_m, 0.1) * radius_m, -1.0, 0.05)
          << "seed " << seed << ' ' << s_m;
    }
  }
}

TEST(DrivingLine, ChordsHeadAlongThePath) {
  const ReferencePath path = ring(1.0);
  for (const double s_m : test::every(0.1, 0.0, 6.0)) {
    EXPECT_NEAR(wrap_angle(chord_heading_rad(path, s_m, 0.05) - std::numbers::pi / 2.0 - s_m), 0.0,
                1e-3);
  }
}

TEST(DrivingLines, WithoutNeighbourLanesTheyAreThePaths) {
  expect_everywhere(lines_of({ring(1.0)}).front(), ring(1.0), 0.0);
  // Neither a path in the same lane nor one beyond the neighbour lane is a neighbour.
  for (const double other_m : {1.0, 1.01, 1.0 + 2.0 * kLane_m}) {
    expect_everywhere(lines_of({ring(1.0), ring(other_m)}).front(), ring(1.0), 0.0);
  }
}

TEST(DrivingLines, AreMovedAwayFromASingleNeighbourLaneByTheFormula) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(5); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const double inner_m = std::uniform_real_distribution(0.5, 2.0)(random);
    const double outer_m = inner_m + kLane_m;
    for (const double turns : {1.0, -1.0}) {
      for (const double others_turns : {1.0, -1.0}) {
        const ReferencePath inner = ring(inner_m, turns);
        const ReferencePath outer = ring(outer_m, others_turns);
        const std::vector<DrivingLine> lines = lines_of({inner, outer});
        // The inner one has its kerb inside: to the left, if it turns left.
        expect_everywhere(lines[0], inner, turns * moved_m(turns, turns / inner_m));
        expect_everywhere(lines[1], outer,
                          -others_turns * moved_m(-others_turns, others_turns / outer_m));
      }
    }
  }
}

TEST(DrivingLines, AreNotMovedBetweenTwoNeighbourLanes) {
  const std::vector<ReferencePath> rings{ring(1.0 - kLane_m), ring(1.0), ring(1.0 + kLane_m)};
  const std::vector<DrivingLine> lines = lines_of(rings);
  expect_everywhere(lines[0], rings[0], moved_m(1.0, 1.0 / (1.0 - kLane_m)));
  expect_everywhere(lines[1], rings[1], 0.0);
  expect_everywhere(lines[2], rings[2], -moved_m(-1.0, 1.0 / (1.0 + kLane_m)));
}

TEST(DrivingLines, ARouteThatCrossesIsNoNeighbour) {
  std::vector<Point> points_m;  // across the ring, where both are a lane's width apart and after
  for (int i = 0; i < 200; ++i) points_m.emplace_back(-3.0 + 0.03 * i, 0.0);
  points_m.emplace_back(3.0, 5.0);
  points_m.emplace_back(-3.0, 5.0);
  const ReferencePath across(points_m, true);
  expect_everywhere(lines_of({ring(1.0), across}).front(), ring(1.0), 0.0);
}

TEST(DrivingLines, AreWithoutJumps) {
  // A neighbour for a part of the way only.
  std::vector<Point> points_m;
  for (int i = 0; i <= 100; ++i) points_m.emplace_back(-0.5 + 0.01 * i, -1.0 - kLane_m);
  points_m.emplace_back(3.0, -3.0);
  points_m.emplace_back(-3.0, -3.0);
  const ReferencePath path = ring(1.0);
  const DrivingLine line = lines_of({path, ReferencePath(points_m, true)}).front();
  double most_m = 0.0;
  for (const double s_m : test::every(0.01, 0.0, path.length_m())) {
    most_m = std::max(most_m, std::abs(line.left_m(s_m)));
    EXPECT_LT(std::abs(line.left_m(s_m + 0.01) - line.left_m(s_m)), 0.001) << s_m;
  }
  EXPECT_GT(most_m, 0.005);
  EXPECT_LE(most_m, moved_m(1.0, 1.0) + 1e-4);
}

}  // namespace
}  // namespace hlc::road::driving_line_test
