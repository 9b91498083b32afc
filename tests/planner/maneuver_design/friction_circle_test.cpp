#include "planner/maneuver_design/friction_circle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/planner/maneuver_design/gradient_check.hpp"

namespace hlc::maneuver_design {
namespace {

TEST(FrictionCircle, IsZeroWhereTheAccelerationIsJustAllowed) {
  const vehicle::VehicleParameters vehicle;
  const FrictionCircle circle(5.0, vehicle);
  const vehicle::StateVector straight = vehicle::to_vector({{}, 2.0, 0.0});
  EXPECT_EQ(circle.value(straight, {5.0, 3.0}), 0.0);
  EXPECT_EQ(circle.value(straight, {-5.0, 0.0}), 0.0);
  EXPECT_EQ(circle.value(straight, {0.0, 6.0}), -1.0);
  // A trim with 3 m/s^2 across leaves 4 lengthwise.
  const double speed = std::sqrt(3.0 / vehicle::curvature_per_m(0.4, vehicle));
  EXPECT_NEAR(circle.value(vehicle::to_vector({{}, speed, 0.4}), {4.0, 0.0}), 0.0, 1e-13);
}

TEST(FrictionCircle, HasAnExactGradient) {
  expect_exact_gradient(FrictionCircle(10.0, vehicle::VehicleParameters{}), 109);
}

}  // namespace
}  // namespace hlc::maneuver_design
