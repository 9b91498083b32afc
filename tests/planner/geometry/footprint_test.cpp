#include "planner/geometry/footprint.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hlc {
namespace {

TEST(Footprint, CornersLieHalfLengthAndHalfWidthFromThePose) {
  const ConvexPolygon area = footprint_area({0.220, 0.107}, {1.0, 2.0, std::numbers::pi / 2.0});
  ASSERT_EQ(area.vertices_m.size(), 4U);
  const Box box = bounding_box(area);
  EXPECT_NEAR(box.min_m.x(), 1.0 - 0.0535, 1e-15);
  EXPECT_NEAR(box.max_m.x(), 1.0 + 0.0535, 1e-15);
  EXPECT_NEAR(box.min_m.y(), 2.0 - 0.110, 1e-15);
  EXPECT_NEAR(box.max_m.y(), 2.0 + 0.110, 1e-15);
}

TEST(Footprint, TheMarginIsAddedOnEverySide) {
  const Box box = bounding_box(footprint_area({0.220, 0.107}, {}, 0.010));
  EXPECT_NEAR(box.max_m.x(), 0.120, 1e-15);
  EXPECT_NEAR(box.min_m.x(), -0.120, 1e-15);
  EXPECT_NEAR(box.max_m.y(), 0.0635, 1e-15);
  EXPECT_NEAR(box.min_m.y(), -0.0635, 1e-15);
}

TEST(Footprint, VerticesRunCounterClockwise) {
  const ConvexPolygon area = footprint_area({0.220, 0.107}, {0.3, 0.1, 2.0});
  EXPECT_TRUE(contains(area, {0.3, 0.1}));  // inside is on the left of every edge
}

}  // namespace
}  // namespace hlc
