#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "planner/geometry/footprint.hpp"

namespace {
std::size_t num_allocations = 0;
}  // namespace

void* operator new(std::size_t size) {
  ++num_allocations;
  void* const memory = std::malloc(size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

namespace hlc {
namespace {

TEST(Polygon, IntersectionTestsDoNotAllocate) {
  const ConvexPolygon a = footprint_area({2.0, 1.0}, {0.0, 0.0, 0.3});
  const ConvexPolygon b = footprint_area({2.0, 1.0}, {0.5, 0.5, 1.0});
  const Segment segment{{-2.0, 0.0}, {2.0, 0.1}};
  const std::size_t before = num_allocations;
  const bool polygons = intersects(a, b);
  const bool boxes = overlap(bounding_box(a), bounding_box(b));
  const bool with_segment = intersects(a, segment);
  const std::size_t after = num_allocations;
  EXPECT_EQ(after, before);
  EXPECT_TRUE(polygons && boxes && with_segment);
  EXPECT_GT(before, 0U);  // the counter counts
}

}  // namespace
}  // namespace hlc
