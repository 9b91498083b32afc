#include "planner/geometry/separating_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "planner/geometry/footprint.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc {
namespace {

ConvexPolygon square_at(double x, double y) { return footprint_area({1.0, 1.0}, {x, y, 0.0}); }

double beyond_m(const SeparatingLine& line, const Point& point) {
  return std::cos(line.direction_rad) * point.x() + std::sin(line.direction_rad) * point.y() -
         line.offset_m;
}

TEST(SeparatingLine, TouchesTheFirstPolygonAndPointsToTheSecond) {
  const auto line = separating_line(square_at(0.0, 0.0), square_at(3.0, 0.2), 0.0);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->direction_rad, 0.0, 1e-12);
  EXPECT_NEAR(line->offset_m, 0.5, 1e-12);
  const auto back = separating_line(square_at(3.0, 0.2), square_at(0.0, 0.0), 0.0);
  ASSERT_TRUE(back);
  EXPECT_NEAR(std::abs(back->direction_rad), std::numbers::pi, 1e-12);
  EXPECT_NEAR(back->offset_m, -2.5, 1e-12);
}

TEST(SeparatingLine, HasTheDirectionOfTheLargestGapWhereNoneIsWide) {
  const double narrow_m = 1.0 + 0.5 * kWideGap_m;
  const auto up = separating_line(square_at(0.0, 0.0), square_at(0.9, narrow_m), 0.0);
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->direction_rad, 0.5 * std::numbers::pi, 1e-12);
  const auto wider = separating_line(square_at(0.0, 0.0), square_at(narrow_m, 1.001), 0.0);
  ASSERT_TRUE(wider);
  EXPECT_NEAR(wider->direction_rad, 0.0, 1e-12);
}

TEST(SeparatingLine, HasTheFirstDirectionWithAWideGap) {
  const auto line = separating_line(square_at(0.0, 0.0), square_at(1.1, 4.0), 0.0);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->direction_rad, 0.0, 1e-12) << "the edge to the right is before the upper one";
}

TEST(SeparatingLine, ExistsUpToTheTolerance) {
  EXPECT_TRUE(separating_line(square_at(0.0, 0.0), square_at(0.9995, 0.0), 1e-3));
  EXPECT_FALSE(separating_line(square_at(0.0, 0.0), square_at(0.9985, 0.0), 1e-3));
  EXPECT_FALSE(separating_line(square_at(0.0, 0.0), {}, 1e-3));
  EXPECT_FALSE(separating_line({}, square_at(0.0, 0.0), 1e-3));
}

TEST(SeparatingLine, ExistsExactlyWhereRandomPolygonsDoNotIntersect) {
  std::uint64_t num_apart = 0;
  const std::uint64_t num_seeds = test::num_seeds(2000);
  for (std::uint64_t seed = 1; seed <= num_seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random{seed};
    std::uniform_real_distribution<double> value{-1.0, 1.0};
    const auto polygon = [&](double x) {
      std::vector<Point> points;
      for (int i = 0; i < 7; ++i) points.emplace_back(x + value(random), value(random));
      return convex_hull(points);
    };
    const ConvexPolygon a = polygon(0.0);
    const ConvexPolygon b = polygon(1.5);
    const auto line = separating_line(a, b, 0.0);
    ASSERT_EQ(line.has_value(), !intersects(a, b));
    if (!line) continue;
    ++num_apart;
    double nearest_m = 1e9;
    double farthest_m = -1e9;
    for (const Point& corner : a.vertices_m)
      farthest_m = std::max(farthest_m, beyond_m(*line, corner));
    for (const Point& corner : b.vertices_m)
      nearest_m = std::min(nearest_m, beyond_m(*line, corner));
    EXPECT_NEAR(farthest_m, 0.0, 1e-12);
    EXPECT_GE(nearest_m, -1e-12);
  }
  EXPECT_GT(num_apart, num_seeds / 20);
  EXPECT_LT(num_apart, num_seeds);
}

}  // namespace
}  // namespace hlc
