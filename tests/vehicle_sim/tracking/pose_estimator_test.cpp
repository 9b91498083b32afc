#include "vehicle_sim/tracking/pose_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hlc::tracking::pose_estimator_test {
namespace {

const vehicle::IdentifiedVehicle kVehicle;

TEST(PoseEstimator, FirstMeasurementIsTakenAsItIs) {
  PoseEstimator estimator(kVehicle);
  const Pose pose{.x_m = 1.0, .y_m = 2.0, .heading_rad = 3.0};
  const vehicle::VehicleMotion estimate =
      estimator.update(pose, 0.5, {.throttle = 1.0, .steering = 1.0});
  EXPECT_EQ(estimate, (vehicle::VehicleMotion{.pose = pose, .speed_mps = 0.5}));
}

TEST(PoseEstimator, ExactMeasurementsStayExactBitForBit) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  PoseEstimator estimator(kVehicle);
  vehicle::VehicleMotion truth{.pose = {.x_m = 1.0, .y_m = 2.0, .heading_rad = 0.3},
                               .speed_mps = 0.0};
  vehicle::ActuatorInput acted;
  for (int i = 0; i < 2'000; ++i) {
    ASSERT_EQ(estimator.update(truth.pose, truth.speed_mps, acted), truth) << i;
    acted = {.throttle = unit(random), .steering = unit(random)};
    truth = vehicle::stepped(truth, acted, kVehicle);
  }
}

TEST(PoseEstimator, TakesOverThreeTenthsOfADifference) {
  PoseEstimator estimator(kVehicle);
  static_cast<void>(estimator.update({}, 0.0, {}));
  const Pose jumped{.x_m = 0.1, .y_m = -0.2, .heading_rad = 0.05};
  const vehicle::VehicleMotion estimate = estimator.update(jumped, 0.0, {});
  EXPECT_NEAR(estimate.pose.x_m, 0.03, 1e-12);
  EXPECT_NEAR(estimate.pose.y_m, -0.06, 1e-12);
  EXPECT_NEAR(estimate.pose.heading_rad, 0.015, 1e-12);
}

TEST(PoseEstimator, HeadingIsCorrectedAlongTheShorterArc) {
  constexpr double kPi = std::numbers::pi;
  PoseEstimator estimator(kVehicle);
  static_cast<void>(estimator.update({.heading_rad = kPi - 0.01}, 0.0, {}));
  const vehicle::VehicleMotion estimate = estimator.update({.heading_rad = -kPi + 0.01}, 0.0, {});
  EXPECT_NEAR(estimate.pose.heading_rad, kPi - 0.01 + 0.3 * 0.02, 1e-9);
}

TEST(PoseEstimator, HalvesTheNoise) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> noise(-0.002, 0.002);
  PoseEstimator estimator(kVehicle);
  double measured_squares = 0.0;
  double estimated_squares = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    const double x_m = noise(random);
    const double estimated_m = estimator.update({.x_m = x_m}, 0.0, {}).pose.x_m;
    measured_squares += x_m * x_m;
    estimated_squares += estimated_m * estimated_m;
  }
  EXPECT_NEAR(std::sqrt(estimated_squares / measured_squares), std::sqrt(0.3 / 1.7), 0.02);
}

}  // namespace
}  // namespace hlc::tracking::pose_estimator_test
