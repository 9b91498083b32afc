#include "planner/road/curvature_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace hlc::road {
namespace {

constexpr Pose kStart{.x_m = 1.0, .y_m = 2.0, .heading_rad = 0.3};

TEST(CurvatureCurve, ConstantCurvatureIsACircle) {
  const double radius_m = 0.5;
  const CurvatureCurve curve(kStart, {{0.0, 1.0 / radius_m}, {1.0, 1.0 / radius_m}, {3.0, 2.0}});
  for (double s = 0.0; s <= 3.0; s += 0.1) {
    const double heading = kStart.heading_rad + s / radius_m;
    EXPECT_NEAR(curve.at(s).heading_rad, heading, 1e-12);
    EXPECT_NEAR(curve.at(s).x_m, 1.0 + radius_m * (std::sin(heading) - std::sin(0.3)), 1e-9);
    EXPECT_NEAR(curve.at(s).y_m, 2.0 - radius_m * (std::cos(heading) - std::cos(0.3)), 1e-9);
  }
}

TEST(CurvatureCurve, PoseIsTheIntegralOfTheCurvature) {
  const CurvatureCurve curve(kStart, {{0.0, -3.0}, {0.4, 2.0}, {1.0, 0.5}});
  constexpr double h = 1e-5;
  for (double s = 0.05; s < 1.0; s += 0.1) {
    const double kappa = s < 0.4 ? -3.0 + 12.5 * s : 2.0 - 2.5 * (s - 0.4);
    const Pose a = curve.at(s - h);
    const Pose b = curve.at(s + h);
    EXPECT_NEAR((b.heading_rad - a.heading_rad) / (2 * h), kappa, 1e-6) << s;
    EXPECT_NEAR((b.x_m - a.x_m) / (2 * h), std::cos(curve.at(s).heading_rad), 1e-6) << s;
    EXPECT_NEAR((b.y_m - a.y_m) / (2 * h), std::sin(curve.at(s).heading_rad), 1e-6) << s;
  }
}

TEST(CurvatureCurve, RefusesKnotsThatDoNotAscendFromZero) {
  EXPECT_THROW(CurvatureCurve(kStart, {{0.0, 1.0}}), std::invalid_argument);
  EXPECT_THROW(CurvatureCurve(kStart, {{0.1, 1.0}, {1.0, 1.0}}), std::invalid_argument);
  EXPECT_THROW(CurvatureCurve(kStart, {{0.0, 1.0}, {0.0, 1.0}}), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::road
