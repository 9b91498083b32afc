#include "planner/coordination/messages.hpp"

#include <gtest/gtest.h>

#include "planner/geometry/footprint.hpp"

namespace hlc {
namespace {

ConvexPolygon square_at(double x) { return footprint_area({1.0, 1.0}, {x, 0.0, 0.0}); }

TEST(OccupiedAreas, EveryStepHasItsAreaAndTheFinalOneHoldsForEver) {
  const OccupiedAreas areas{
      .first = {5}, .areas_m = {square_at(0.0), square_at(1.0)}, .final_area_m = square_at(2.0)};
  EXPECT_EQ(areas.during({5}), square_at(0.0));
  EXPECT_EQ(areas.during({6}), square_at(1.0));
  EXPECT_EQ(areas.during({7}), square_at(2.0));
  EXPECT_EQ(areas.during({700}), square_at(2.0));
}

}  // namespace
}  // namespace hlc
