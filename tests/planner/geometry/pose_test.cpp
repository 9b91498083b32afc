#include "planner/geometry/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hlc {
namespace {

constexpr double kPi = std::numbers::pi;

Pose random_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> position(-5.0, 5.0);
  std::uniform_real_distribution<double> heading(-4.0, 4.0);
  return {position(random), position(random), heading(random)};
}

void expect_near(const Pose& a, const Pose& b) {
  EXPECT_NEAR(a.x_m, b.x_m, 1e-12);
  EXPECT_NEAR(a.y_m, b.y_m, 1e-12);
  EXPECT_NEAR(a.heading_rad, b.heading_rad, 1e-12);
}

TEST(Pose, ComposeGoesForwardAlongTheHeadingOfTheFirst) {
  expect_near(compose({1.0, 2.0, kPi / 2.0}, {3.0, 1.0, 0.5}), {0.0, 5.0, kPi / 2.0 + 0.5});
}

TEST(Pose, BetweenUndoesCompose) {
  constexpr unsigned kSeed = 1;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  for (int i = 0; i < 1000; ++i) {
    const Pose a = random_pose(random);
    const Pose b = random_pose(random);
    expect_near(compose(a, between(a, b)), b);
    expect_near(between(a, compose(a, b)), b);
  }
}

TEST(Pose, ComposeIsAssociative) {
  constexpr unsigned kSeed = 2;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  for (int i = 0; i < 1000; ++i) {
    const Pose a = random_pose(random);
    const Pose b = random_pose(random);
    const Pose c = random_pose(random);
    expect_near(compose(compose(a, b), c), compose(a, compose(b, c)));
  }
}

TEST(Pose, APointMovesAsThePositionOfAPose) {
  const Pose frame{1.0, -2.0, 0.7};
  const Pose pose{0.3, 0.4, 1.0};
  EXPECT_NEAR((transformed(pose.position_m(), frame) - compose(frame, pose).position_m()).norm(),
              0.0, 1e-15);
}

TEST(Pose, WrappedAnglesLieAboveMinusPiAndUpToPi) {
  EXPECT_EQ(wrap_angle(0.5), 0.5);
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(3.0 * kPi), kPi, 1e-15);
  for (double angle = -20.0; angle < 20.0; angle += 0.01) {
    const double wrapped = wrap_angle(angle);
    EXPECT_GT(wrapped, -kPi);
    EXPECT_LE(wrapped, kPi);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-14);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-14);
  }
}

}  // namespace
}  // namespace hlc
