#include "planner/maneuver_design/distance.hpp"

#include <gtest/gtest.h>

#include "planner/maneuver_design/shooting.hpp"
#include "tests/planner/maneuver_design/gradient_check.hpp"

namespace hlc::maneuver_design {
namespace {

TEST(Distance, IsTheNegativeSquareOfTheDistanceFromTheStart) {
  vehicle::StateVector x;
  x << 3.0, -4.0, 1.0, 2.0, 0.1;
  EXPECT_EQ(Distance{}.value(x, {12.0, 6.0}), -25.0);
}

TEST(Distance, OfAStraightDriveAtConstantSpeedIsACubeOfTime) {
  const vehicle::State start{{}, 2.0, 0.0};
  const std::vector<vehicle::Input> none(5);
  EXPECT_NEAR(shoot(start, none, 0.3, Distance{}, {}, WithGradient::kNo).cost, -4.0 * 0.009, 1e-15);
}

TEST(Distance, DependsOnThePose) { EXPECT_TRUE(Distance{}.depends_on_pose()); }

TEST(Distance, HasAnExactGradient) { expect_exact_gradient(Distance{}, 101); }

}  // namespace
}  // namespace hlc::maneuver_design
