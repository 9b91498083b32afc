#include "planner/maneuver_design/effort.hpp"

#include <gtest/gtest.h>

#include "tests/planner/maneuver_design/gradient_check.hpp"

namespace hlc::maneuver_design {
namespace {

TEST(Effort, IsTheSquareOfTheInput) {
  EXPECT_EQ(Effort{}.value(vehicle::StateVector::Zero(), {3.0, -4.0}), 25.0);
  EXPECT_FALSE(Effort{}.depends_on_pose());
}

TEST(Effort, HasAnExactGradient) { expect_exact_gradient(Effort{}, 103); }

}  // namespace
}  // namespace hlc::maneuver_design
