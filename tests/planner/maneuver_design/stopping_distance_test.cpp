#include "planner/maneuver_design/stopping_distance.hpp"

#include <gtest/gtest.h>

#include "planner/maneuver_design/distance.hpp"
#include "tests/planner/maneuver_design/gradient_check.hpp"

namespace hlc::maneuver_design {
namespace {

TEST(StoppingDistance, IsTheOppositeOfDistance) {
  vehicle::StateVector x;
  x << 3.0, -4.0, 1.0, 2.0, 0.1;
  EXPECT_EQ(StoppingDistance{}.value(x, {}), 25.0);
  EXPECT_EQ(StoppingDistance{}.value(x, {}), -Distance{}.value(x, {}));
  EXPECT_TRUE(StoppingDistance{}.depends_on_pose());
}

TEST(StoppingDistance, HasAnExactGradient) { expect_exact_gradient(StoppingDistance{}, 102); }

}  // namespace
}  // namespace hlc::maneuver_design
