#include <gtest/gtest.h>

#include "planner/geometry/footprint.hpp"
#include "tests/support/allocation_counter.hpp"

namespace hlc {
namespace {

TEST(Polygon, IntersectionTestsDoNotAllocate) {
  const ConvexPolygon a = footprint_area({2.0, 1.0}, {0.0, 0.0, 0.3});
  const ConvexPolygon b = footprint_area({2.0, 1.0}, {0.5, 0.5, 1.0});
  const Segment segment{{-2.0, 0.0}, {2.0, 0.1}};
  const std::size_t before = test::num_allocations();
  const bool polygons = intersects(a, b);
  const bool boxes = overlap(bounding_box(a), bounding_box(b));
  const bool with_segment = intersects(a, segment);
  const std::size_t after = test::num_allocations();
  EXPECT_EQ(after, before);
  EXPECT_TRUE(polygons && boxes && with_segment);
  EXPECT_GT(before, 0U);  // the counter counts
}

}  // namespace
}  // namespace hlc
