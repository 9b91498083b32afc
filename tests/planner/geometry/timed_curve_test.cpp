#include "planner/geometry/timed_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hlc {
namespace {

TimedPoint random_point(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-2.0, 2.0);
  return {.time_s = 0.0,
          .position_m = {unit(random), unit(random)},
          .velocity_mps = {unit(random), unit(random)}};
}

TEST(TimedCurve, MeetsBothPointsWithTheirVelocities) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const TimedPoint a = random_point(random);
    const TimedPoint b = random_point(random);
    const CurveSample begin = interpolated(a, b, 0.3, 0.0);
    const CurveSample end = interpolated(a, b, 0.3, 1.0);
    EXPECT_LT((begin.position_m - a.position_m).norm(), 1e-12);
    EXPECT_LT((begin.velocity_mps - a.velocity_mps).norm(), 1e-12);
    EXPECT_LT((end.position_m - b.position_m).norm(), 1e-12);
    EXPECT_LT((end.velocity_mps - b.velocity_mps).norm(), 1e-12);
  }
}

TEST(TimedCurve, VelocityAndAccelerationAreTheDerivativesInTime) {
  constexpr double kDuration_s = 0.3;
  constexpr double kStep = 1e-6;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const TimedPoint a = random_point(random);
    const TimedPoint b = random_point(random);
    for (const double share : {0.1, 0.5, 0.8}) {
      const CurveSample at = interpolated(a, b, kDuration_s, share);
      const CurveSample before = interpolated(a, b, kDuration_s, share - kStep);
      const CurveSample after = interpolated(a, b, kDuration_s, share + kStep);
      const double twice_s = 2.0 * kStep * kDuration_s;
      EXPECT_LT(((after.position_m - before.position_m) / twice_s - at.velocity_mps).norm(), 1e-6);
      EXPECT_LT(
          ((after.velocity_mps - before.velocity_mps) / twice_s - at.acceleration_mps2).norm(),
          1e-5);
    }
  }
}

TEST(TimedCurve, CurvatureOfACircleIsOneOverItsRadiusPositiveToTheLeft) {
  constexpr double kRadius_m = 0.5;
  constexpr double kTurn_rad = 0.05;
  const TimedPoint a{.position_m = {kRadius_m, 0.0}, .velocity_mps = {0.0, kRadius_m}};
  const TimedPoint b{.position_m = kRadius_m * Point(std::cos(kTurn_rad), std::sin(kTurn_rad)),
                     .velocity_mps = kRadius_m * Point(-std::sin(kTurn_rad), std::cos(kTurn_rad))};
  EXPECT_NEAR(interpolated(a, b, kTurn_rad, 0.5).curvature_per_m(), 2.0, 1e-3);
  EXPECT_EQ((CurveSample{{}, {0.0, 0.0}, {1.0, 1.0}}.curvature_per_m()), 0.0) << "at standstill";
}

}  // namespace
}  // namespace hlc
