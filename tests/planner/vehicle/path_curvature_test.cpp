#include "planner/vehicle/path_curvature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hlc::vehicle {
namespace {

const VehicleParameters kVehicle;

double course_rad(const State& state) {
  return state.pose.heading_rad + slip_angle_rad(state.steering_rad, kVehicle);
}

TEST(PathCurvature, CourseRateIsHowFastTheCourseTurns) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr double kStep_s = 1e-5;
  for (int run = 0; run < 200; ++run) {
    const State state{{}, 1.0 + unit(random), 0.6 * unit(random)};
    const Input input{8.0 * unit(random), 6.0 * unit(random)};
    const double before = course_rad(integrated(state, input, -kStep_s, kVehicle));
    const double after = course_rad(integrated(state, input, kStep_s, kVehicle));
    EXPECT_NEAR(course_rate(to_vector(state), input, kVehicle).value_radps,
                (after - before) / (2.0 * kStep_s), 1e-6);
  }
}

TEST(PathCurvature, OfATrimIsThatOfItsSteering) {
  const CourseRate rate = course_rate(to_vector({{}, 0.5, 0.48}), {}, kVehicle);
  EXPECT_DOUBLE_EQ(rate.value_radps, 0.5 * curvature_per_m(0.48, kVehicle));
}

TEST(PathCurvature, LimitHoldsToBothSidesAndIsWiderOnlyNearStandstill) {
  VehicleLimits limits;
  const State left{{}, 0.4, 0.6};  // 4.315 1/m
  const State right{{}, 0.4, -0.6};
  EXPECT_TRUE(is_within_curvature(left, {}, kVehicle, limits)) << "there is no limit";
  limits.curvature_max_per_m = 4.35;
  EXPECT_TRUE(is_within_curvature(left, {}, kVehicle, limits));
  EXPECT_TRUE(is_within_curvature(right, {}, kVehicle, limits));
  EXPECT_FALSE(is_within_curvature(left, {0.0, 0.5}, kVehicle, limits)) << "it steers in";
  EXPECT_TRUE(is_within_curvature(left, {0.0, -0.5}, kVehicle, limits)) << "it steers out";
  EXPECT_FALSE(is_within_curvature(right, {0.0, -0.5}, kVehicle, limits));
  limits.curvature_max_per_m = 4.2;
  EXPECT_FALSE(is_within_curvature(left, {}, kVehicle, limits));
  EXPECT_FALSE(is_within_curvature(right, {}, kVehicle, limits));
  EXPECT_TRUE(is_within_curvature({{}, 0.0, 0.6}, {}, kVehicle, limits));
  EXPECT_LT(turning_speed(0.1).value_mps, 0.105);
  EXPECT_LT(turning_speed(0.22).value_mps, 0.2222);
}

}  // namespace
}  // namespace hlc::vehicle
