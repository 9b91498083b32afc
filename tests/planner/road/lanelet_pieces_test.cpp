#include "planner/road/lanelet_pieces.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "planner/geometry/footprint.hpp"
#include "tests/support/commonroad_samples.hpp"

namespace hlc::road::lanelet_pieces_test {
namespace {

Lanelet lanelet_along(const test::Line& line) {
  return parse_lanelet_map(test::CommonRoadSketch().lane(1, line).xml(), "sketch").lanelets.at(1);
}

TEST(LaneletPieces, ContainWhatIsBetweenTheBounds) {
  const Lanelet lanelet = lanelet_along(test::arc({0.0, 0.0, 0.0}, 20.0, std::numbers::pi / 2.0));
  for (const Point& middle_m : centre_line_m(lanelet)) EXPECT_TRUE(contains(lanelet, middle_m));
  for (std::size_t i = 0; i < lanelet.left_m.size(); ++i) {
    const Point across_m = lanelet.left_m[i] - lanelet.right_m[i];
    EXPECT_FALSE(contains(lanelet, lanelet.left_m[i] + 0.05 * across_m));
    EXPECT_FALSE(contains(lanelet, lanelet.right_m[i] - 0.05 * across_m));
  }
}

TEST(LaneletPieces, OfAStraightLaneAreConvexTogether) {
  const Lanelet lanelet = lanelet_along(test::straight({0.0, 0.0}, {80.0, 30.0}));
  const ConvexPolygon part = convex_part_of(lanelet, 32);
  for (const auto* bound : {&lanelet.left_m, &lanelet.right_m}) {
    for (const Point& corner : *bound) EXPECT_TRUE(contains(part, corner, 1e-6));
  }
}

TEST(LaneletPieces, OfABendHaveAPartBetweenTheBounds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius_m(8.0, 60.0);
  std::uniform_real_distribution<double> turned_rad(0.3, 2.5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const double radius = radius_m(random);
    const double turned = turned_rad(random);
    SCOPED_TRACE(testing::Message() << "seed 5, draw " << i << ": " << radius << " m, " << turned);
    const Lanelet lanelet = lanelet_along(test::arc({3.0, 4.0, 0.5}, radius, side * turned));
    const ConvexPolygon part = convex_part_of(lanelet, 32);
    ASSERT_FALSE(part.empty());
    for (int k = 0; k < 50; ++k) {  // any point of it, by the triangles at its first corner
      const auto& corners = part.vertices_m;
      const std::size_t at = 1 + static_cast<std::size_t>(k) % (corners.size() - 2);
      const double a = share(random);
      const double b = (1.0 - a) * share(random);
      const Point inside =
          corners[0] + a * (corners[at] - corners[0]) + b * (corners[at + 1] - corners[0]);
      EXPECT_TRUE(contains(lanelet, inside)) << inside.transpose();
    }
  }
}

TEST(LaneletPieces, KnowConvexCorners) {
  EXPECT_TRUE(is_convex({{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {0.0, 1.0}}));
  EXPECT_TRUE(is_convex({{0.0, 1.0}, {2.0, 1.0}, {2.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}}));
  EXPECT_FALSE(is_convex({{0.0, 0.0}, {2.0, 0.0}, {0.5, 0.5}, {0.0, 2.0}}));
  EXPECT_FALSE(is_convex({{0.0, 0.0}, {2.0, 0.0}, {4.0, 0.0}}));
}

}  // namespace
}  // namespace hlc::road::lanelet_pieces_test
