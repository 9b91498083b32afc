#include "planner/road/reference_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tests/support/num_seeds.hpp"

namespace hlc::road {
namespace {

/// A random polyline whose neighbours are 5 to 30 cm apart.
std::vector<Point> random_points(std::mt19937_64& random, std::size_t count) {
  std::uniform_real_distribution<double> step_m(0.05, 0.3);
  std::uniform_real_distribution<double> turn_rad(-1.2, 1.2);
  std::vector<Point> points{Point(0.0, 0.0)};
  double heading_rad = 0.0;
  while (points.size() < count) {
    heading_rad += turn_rad(random);
    points.emplace_back(points.back() +
                        step_m(random) * Point(std::cos(heading_rad), std::sin(heading_rad)));
  }
  return points;
}

/// Nearest of many points with s in [from, to], 0.2 mm apart: never nearer than the exact one, and
/// farther by at most half the spacing.
double sampled_distance_m(const ReferencePath& path, const Point& point, double from, double to) {
  double best = std::numeric_limits<double>::infinity();
  const double count = std::ceil((to - from) / 2e-4);
  for (double k = 0.0; k <= count; ++k) {
    const double s = count == 0.0 ? from : from + (to - from) * k / count;
    best = std::min(best, (path.at(s) - point).norm());
  }
  return best;
}

const std::vector<Point> kSquare = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};

TEST(ReferencePath, ClosedPathHasTheLastSideAndRepeats) {
  const ReferencePath path(kSquare, true);
  EXPECT_DOUBLE_EQ(path.length_m(), 4.0);
  EXPECT_EQ(path.at(3.5), Point(0.0, 0.5));
  EXPECT_EQ(path.at(4.5), Point(0.5, 0.0));
  EXPECT_EQ(path.at(-0.5), Point(0.0, 0.5));
  EXPECT_EQ(path.at(-1e-20), Point(0.0, 0.0));
  EXPECT_EQ(path.joints_s_m(), (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0}));
}

TEST(ReferencePath, OpenPathStopsAtItsEnds) {
  const ReferencePath path(kSquare, false);
  EXPECT_DOUBLE_EQ(path.length_m(), 3.0);
  EXPECT_EQ(path.at(-1.0), Point(0.0, 0.0));
  EXPECT_EQ(path.at(7.0), Point(0.0, 1.0));
  EXPECT_DOUBLE_EQ(path.project(Point(-5.0, 1.0)).s_m, 3.0);
}

TEST(ReferencePath, HeadingIsThatOfTheSegmentAndOfTheLaterOneAtAJoint) {
  const ReferencePath path(kSquare, true);
  EXPECT_DOUBLE_EQ(path.heading_rad_at(0.5), 0.0);
  EXPECT_DOUBLE_EQ(path.heading_rad_at(1.0), std::numbers::pi / 2.0);
  EXPECT_DOUBLE_EQ(path.heading_rad_at(2.5), std::numbers::pi);
  EXPECT_DOUBLE_EQ(path.heading_rad_at(-0.5), -std::numbers::pi / 2.0);
  EXPECT_EQ(path.heading_rad_at(-1e-20), 0.0);  // rounds to the end, which is the beginning
  EXPECT_DOUBLE_EQ(ReferencePath(kSquare, false).heading_rad_at(9.0), std::numbers::pi);
}

TEST(ReferencePath, ProjectionOnAJointIsTheSmallestArcLength) {
  const ReferencePath path(kSquare, true);
  EXPECT_EQ(path.project(Point(-1.0, -1.0)).s_m, 0.0);
  EXPECT_EQ(path.project(Point(2.0, 2.0)).s_m, 2.0);
  EXPECT_EQ(path.project(Point(0.5, 0.5)).s_m, 0.5);  // all four sides are equally near
  EXPECT_DOUBLE_EQ(path.project(Point(2.0, 2.0)).distance_m, std::sqrt(2.0));
}

TEST(ReferencePath, ProjectionIsTheNearestPointOfThePath) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(20); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const ReferencePath path(random_points(random, 15), seed % 2 == 0);
    std::uniform_real_distribution<double> coordinate_m(-1.5, 1.5);
    for (int i = 0; i < 10; ++i) {
      const Point point(coordinate_m(random), coordinate_m(random));
      const auto projection = path.project(point);
      const double sampled_m = sampled_distance_m(path, point, 0.0, path.length_m());
      EXPECT_LE(projection.distance_m, sampled_m + 1e-12);
      EXPECT_GE(projection.distance_m, sampled_m - 1e-4);
      EXPECT_NEAR((path.at(projection.s_m) - point).norm(), projection.distance_m, 1e-12);
      EXPECT_GE(projection.s_m, 0.0);
      EXPECT_LE(projection.s_m, path.length_m());
    }
  }
}

TEST(ReferencePath, ProjectionWithinAWindowIsTheNearestPointOfTheWindow) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(20); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const ReferencePath path(random_points(random, 15), seed % 2 == 0);
    const double length_m = path.length_m();
    std::uniform_real_distribution<double> coordinate_m(-1.5, 1.5);
    std::uniform_real_distribution<double> from_s(-length_m, 2.0 * length_m);
    std::uniform_real_distribution<double> width_m(0.0, 1.2 * length_m);
    for (int i = 0; i < 20; ++i) {
      const Point point(coordinate_m(random), coordinate_m(random));
      const double from = from_s(random);
      const double to = from + width_m(random);
      const auto projection = path.project_within(point, from, to);
      const double sampled_m = sampled_distance_m(path, point, from, to);
      EXPECT_LE(projection.distance_m, sampled_m + 1e-12);
      EXPECT_GE(projection.distance_m, sampled_m - 1e-4);
      EXPECT_NEAR((path.at(projection.s_m) - point).norm(), projection.distance_m, 1e-12);
      if (path.is_closed()) {
        EXPECT_LT(projection.s_m, length_m);
        const double after_from = std::fmod(projection.s_m - from + 3.0 * length_m, length_m);
        EXPECT_TRUE(after_from <= to - from + 1e-9 || after_from >= length_m - 1e-9);
      } else {
        EXPECT_GE(projection.s_m, std::clamp(from, 0.0, length_m) - 1e-12);
        EXPECT_LE(projection.s_m, std::clamp(to, 0.0, length_m) + 1e-12);
      }
    }
  }
}

TEST(ReferencePath, WindowKeepsTheStrandOnWhichTheVehicleIs) {
  // Two long sides 0.2 m apart: the point is nearer to the lower one.
  const ReferencePath path({{0.0, 0.0}, {3.0, 0.0}, {3.0, 0.2}, {0.0, 0.2}}, true);
  const Point point(1.0, 0.08);
  EXPECT_DOUBLE_EQ(path.project(point).s_m, 1.0);
  EXPECT_DOUBLE_EQ(path.project_within(point, 4.5, 5.5).s_m, 5.2);
}

TEST(ReferencePath, PointThatIsNotFiniteIsInfinitelyFar) {
  const ReferencePath path(kSquare, true);
  const auto projection = path.project(Point(std::nan(""), 0.0));
  EXPECT_TRUE(std::isinf(projection.distance_m));
  EXPECT_EQ(projection.s_m, 0.0);
}

TEST(ReferencePath, RefusesPathsWithoutLength) {
  EXPECT_THROW(ReferencePath({{0.0, 0.0}}, false), std::invalid_argument);
  EXPECT_THROW(ReferencePath({{0.0, 0.0}, {0.0, 0.0}}, false), std::invalid_argument);
  EXPECT_THROW(ReferencePath({{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}}, true), std::invalid_argument);
  EXPECT_THROW(ReferencePath({{0.0, 0.0}, {std::nan(""), 0.0}}, false), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::road
