#include "vehicle_sim/tracking/trajectory.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace hlc::tracking::trajectory_test {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// x(t) and y(t) as polynomials of degree 3 in seconds.
struct Cubic {
  std::array<double, 4> x;
  std::array<double, 4> y;

  static double value(const std::array<double, 4>& c, double t) {
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  }
  static double first(const std::array<double, 4>& c, double t) {
    return c[1] + t * (2 * c[2] + t * 3 * c[3]);
  }
  static double second(const std::array<double, 4>& c, double t) { return 2 * c[2] + 6 * t * c[3]; }

  [[nodiscard]] TrajectoryPoint at(Nanoseconds t) const {
    const double s = 1e-9 * static_cast<double>(t);
    return {.t = t,
            .x_m = value(x, s),
            .y_m = value(y, s),
            .vx_mps = first(x, s),
            .vy_mps = first(y, s)};
  }
};

/// Points every 50 ms from `first_ms` to `last_ms`, straight on along x at 1 m/s.
std::vector<TrajectoryPoint> straight(Nanoseconds first_ms, Nanoseconds last_ms) {
  std::vector<TrajectoryPoint> points;
  for (Nanoseconds t = first_ms * kMillisecond; t <= last_ms * kMillisecond;
       t += 50 * kMillisecond) {
    points.push_back({.t = t, .x_m = 1e-9 * static_cast<double>(t), .vx_mps = 1.0});
  }
  return points;
}

TEST(Trajectory, ReproducesCubicsWithTheirDerivatives) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    Cubic cubic{};
    for (std::size_t j = 0; j < 4; ++j) {
      cubic.x[j] = unit(random);
      cubic.y[j] = unit(random);
    }
    std::vector<TrajectoryPoint> points;
    for (Nanoseconds t = 0; t <= 1'000 * kMillisecond; t += (1 + random() % 200) * kMillisecond) {
      points.push_back(cubic.at(t));
    }
    const Nanoseconds t = random() % (points.back().t + 1);
    const std::optional<CurveSample> got = sample(points, t);
    ASSERT_TRUE(got);
    const double s = 1e-9 * static_cast<double>(t);
    const TrajectoryPoint want = cubic.at(t);
    EXPECT_NEAR(got->position_m.x(), want.x_m, 1e-9);
    EXPECT_NEAR(got->position_m.y(), want.y_m, 1e-9);
    EXPECT_NEAR(got->velocity_mps.x(), want.vx_mps, 1e-9);
    EXPECT_NEAR(got->velocity_mps.y(), want.vy_mps, 1e-9);
    EXPECT_NEAR(got->acceleration_mps2.x(), Cubic::second(cubic.x, s), 1e-6);
    EXPECT_NEAR(got->acceleration_mps2.y(), Cubic::second(cubic.y, s), 1e-6);
  }
}

TEST(Trajectory, PassesThroughItsPointsWithTheirVelocities) {
  const std::vector<TrajectoryPoint> points = {
      {.t = 100, .x_m = 1.0, .y_m = 2.0, .vx_mps = 3.0, .vy_mps = 4.0},
      {.t = 300, .x_m = 1.5, .y_m = 1.0, .vx_mps = -1.0, .vy_mps = 0.0},
      {.t = 350, .x_m = 0.5, .y_m = 0.0, .vx_mps = 0.0, .vy_mps = 2.0}};
  for (const TrajectoryPoint& point : points) {
    const std::optional<CurveSample> got = sample(points, point.t);
    ASSERT_TRUE(got);
    EXPECT_NEAR(got->position_m.x(), point.x_m, 1e-12);
    EXPECT_NEAR(got->position_m.y(), point.y_m, 1e-12);
    // Scaled by a segment of 50 ns, rounding of positions grows to 1e-8 m/s.
    EXPECT_NEAR(got->velocity_mps.x(), point.vx_mps, 1e-6);
    EXPECT_NEAR(got->velocity_mps.y(), point.vy_mps, 1e-6);
  }
}

TEST(Trajectory, ThereIsNoExtrapolation) {
  const std::vector<TrajectoryPoint> points = straight(100, 500);
  EXPECT_FALSE(sample(points, 100 * kMillisecond - 1));
  EXPECT_TRUE(sample(points, 100 * kMillisecond));
  EXPECT_TRUE(sample(points, 500 * kMillisecond));
  EXPECT_FALSE(sample(points, 500 * kMillisecond + 1));
}

TEST(Trajectory, OnePointOrNoneIsNoTrajectory) {
  EXPECT_FALSE(sample({}, 0));
  EXPECT_FALSE(sample(straight(0, 0), 0));
}

TEST(Trajectory, TimesSinceTheEpochLoseNothing) {
  constexpr Nanoseconds kEpoch = 1'700'000'000'000'000'000;
  std::vector<TrajectoryPoint> points = straight(0, 1'000);
  const std::vector<TrajectoryPoint> early = points;
  for (TrajectoryPoint& point : points) {
    point.t += kEpoch;
  }
  for (Nanoseconds t = 0; t <= 1'000 * kMillisecond; t += 7'654'321) {
    EXPECT_EQ(sample(points, kEpoch + t)->position_m, sample(early, t)->position_m);
  }
}

TEST(Trajectory, CurvatureOfACircleIsItsInverseRadius) {
  for (const double radius_m : {0.25, 1.0, -1.0}) {  // negative: to the right
    std::vector<TrajectoryPoint> points;
    for (Nanoseconds t = 0; t <= 1'000 * kMillisecond; t += 20 * kMillisecond) {
      const double angle = 1e-9 * static_cast<double>(t) / radius_m;
      points.push_back({.t = t,
                        .x_m = radius_m * std::sin(angle),
                        .y_m = radius_m * (1.0 - std::cos(angle)),
                        .vx_mps = std::cos(angle),
                        .vy_mps = std::sin(angle)});
    }
    EXPECT_NEAR(sample(points, 333 * kMillisecond)->curvature_per_m(), 1.0 / radius_m, 0.01);
  }
}

TEST(Trajectory, CurvatureAtStandstillIsZero) {
  EXPECT_EQ(
      (CurveSample{
          .position_m = {1.0, 1.0}, .velocity_mps = {0.0, 0.0}, .acceleration_mps2 = {3.0, 4.0}}
           .curvature_per_m()),
      0.0);
}

TEST(Trajectory, IsWellFormedOnlyWithIncreasingTimesAndFiniteNumbers) {
  const std::vector<TrajectoryPoint> good = straight(0, 500);
  EXPECT_TRUE(is_well_formed(good));
  std::vector<TrajectoryPoint> bad = good;
  bad[3].t = bad[2].t;
  EXPECT_FALSE(is_well_formed(bad)) << "equal times";
  bad = good;
  std::swap(bad[3].t, bad[4].t);
  EXPECT_FALSE(is_well_formed(bad)) << "decreasing times";
  for (double TrajectoryPoint::*number : {&TrajectoryPoint::x_m, &TrajectoryPoint::y_m,
                                          &TrajectoryPoint::vx_mps, &TrajectoryPoint::vy_mps}) {
    for (const std::size_t place : {std::size_t{0}, std::size_t{5}, good.size() - 1}) {
      bad = good;
      bad[place].*number = kNan;
      EXPECT_FALSE(is_well_formed(bad));
      bad[place].*number = -std::numeric_limits<double>::infinity();
      EXPECT_FALSE(is_well_formed(bad));
    }
  }
}

TEST(LeadRule, FirstPointMustLieBefore110Milliseconds) {
  const std::vector<TrajectoryPoint> points = straight(1'110, 3'000);
  EXPECT_FALSE(is_followable(points, 1'000 * kMillisecond));
  EXPECT_TRUE(is_followable(points, 1'000 * kMillisecond + 1));
}

TEST(LeadRule, LastPointMustReach360Milliseconds) {
  const std::vector<TrajectoryPoint> points = straight(0, 1'500);
  EXPECT_TRUE(is_followable(points, 1'140 * kMillisecond));
  EXPECT_FALSE(is_followable(points, 1'140 * kMillisecond + 1));
}

TEST(LeadRule, FewerThanTwoPointsAreNotFollowable) {
  EXPECT_FALSE(is_followable({}, 0));
  const std::vector<TrajectoryPoint> one = straight(0, 0);
  EXPECT_FALSE(is_followable(one, 0));
  const std::vector<TrajectoryPoint> two = {{.t = 0}, {.t = 1'000 * kMillisecond}};
  EXPECT_TRUE(is_followable(two, 0)) << "standing is a trajectory";
}

TEST(LeadRule, MalformedPointsAreNotFollowable) {
  std::vector<TrajectoryPoint> points = straight(0, 2'000);
  points.back().x_m = kNan;
  EXPECT_FALSE(is_followable(points, 0));
}

TEST(LeadRule, AccelerationBeyond20IsNotFollowable) {
  const auto accelerating = [](double acceleration_mps2) {
    const Cubic cubic{.x = {0, 0, acceleration_mps2 / 2, 0}, .y = {}};
    std::vector<TrajectoryPoint> points;
    for (Nanoseconds t = 0; t <= 1'000 * kMillisecond; t += 50 * kMillisecond) {
      points.push_back(cubic.at(t));
    }
    return points;
  };
  EXPECT_TRUE(is_followable(accelerating(19.9), 0));
  EXPECT_FALSE(is_followable(accelerating(20.1), 0));
  EXPECT_FALSE(is_followable(accelerating(-20.1), 0));
}

TEST(LeadRule, CurvatureBeyond50IsNotFollowableAboveWalkingSpeed) {
  // A circle of 1 cm: 100 1/m.
  const auto circling = [](double speed_mps) {
    std::vector<TrajectoryPoint> points;
    for (Nanoseconds t = 0; t <= 1'000 * kMillisecond; t += 5 * kMillisecond) {
      const double angle = 100.0 * speed_mps * 1e-9 * static_cast<double>(t);
      points.push_back({.t = t,
                        .x_m = 0.01 * std::sin(angle),
                        .y_m = -0.01 * std::cos(angle),
                        .vx_mps = speed_mps * std::cos(angle),
                        .vy_mps = speed_mps * std::sin(angle)});
    }
    return points;
  };
  EXPECT_FALSE(is_followable(circling(0.12), 0));
  EXPECT_TRUE(is_followable(circling(0.08), 0));
}

TEST(LeadRule, OnlyTheLooksOfThisTickCount) {
  // A jump far ahead is the business of a later tick.
  std::vector<TrajectoryPoint> points = straight(0, 2'000);
  points.back().x_m += 5.0;
  EXPECT_TRUE(is_followable(points, 1'580 * kMillisecond));
  EXPECT_FALSE(is_followable(points, 1'620 * kMillisecond));
}

TEST(LeadRule, HugeNumbersAreRefusedWithoutHarm) {
  std::vector<TrajectoryPoint> points = straight(0, 2'000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].x_m = i % 2 == 0 ? 1e308 : -1e308;
    points[i].vx_mps = 1e308;
  }
  EXPECT_FALSE(is_followable(points, 0));
}

}  // namespace
}  // namespace hlc::tracking::trajectory_test
