#include "planner/vehicle/lab_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/planner/vehicle/cpm_lab.hpp"

namespace hlc::vehicle {
namespace {

using Points = std::vector<TimedPoint>;

/// A drive from standstill in the middle of the lab: speeds up for 1 s, keeps its speed, slows down
/// for 1 s, on a path of constant curvature.
Points drive(double curvature_per_m, double speed_mps, double heading_rad = 0.3) {
  Points points;
  Point position(2.25, 2.0);
  double time_s = 0.0;
  constexpr int kFiner = 25;
  constexpr double kStep_s = 0.001;
  const auto speed_at = [&](double t) {
    return speed_mps * std::max(0.0, std::min({1.0, t, 3.0 - t}));
  };
  const auto direction = [&] { return Point(std::cos(heading_rad), std::sin(heading_rad)); };
  for (int i = 0; time_s < 3.2; ++i) {
    if (i % kFiner == 0) points.push_back({time_s, position, speed_at(time_s) * direction()});
    const double way_m = kStep_s * speed_at(time_s + 0.5 * kStep_s);
    heading_rad += 0.5 * way_m * curvature_per_m;
    position += way_m * direction();
    heading_rad += 0.5 * way_m * curvature_per_m;
    time_s = kStep_s * (i + 1);
  }
  return points;
}

std::optional<TrajectoryFault> found(const Points& points,
                                     const std::optional<LabLimits>& limits = kCpmLab) {
  const auto fault = trajectory_fault(points, limits);
  return fault ? std::optional(fault->fault) : std::nullopt;
}

TEST(LabLimits, WhatTheVehicleCanFollowIsGood) {
  for (const double curvature_per_m : {-3.9, -1.0, 0.0, 1.0, 4.25}) {
    EXPECT_EQ(found(drive(curvature_per_m, 0.4)), std::nullopt) << curvature_per_m;
  }
  EXPECT_EQ(found(Points(1, {0.0, {1.0, 1.0}, {0.0, 0.0}})), std::nullopt) << "standing";
}

TEST(LabLimits, NumbersThatAreNoneAreFound) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Points points = drive(0.0, 0.4);
    points[20].position_m.x() = bad;
    EXPECT_EQ(found(points, std::nullopt), TrajectoryFault::kNotFinite);
    points = drive(0.0, 0.4);
    points[20].velocity_mps.y() = bad;
    EXPECT_EQ(found(points, std::nullopt), TrajectoryFault::kNotFinite);
    points = drive(0.0, 0.4);
    points[20].time_s = bad;
    EXPECT_EQ(found(points, std::nullopt), TrajectoryFault::kNotFinite);
  }
}

TEST(LabLimits, TimesThatStandStillOrGoBackAreFound) {
  for (const double by_s : {0.0, 0.01}) {
    Points points = drive(0.0, 0.4);
    points[20].time_s = points[19].time_s - by_s;
    EXPECT_EQ(found(points, std::nullopt), TrajectoryFault::kTimesNotIncreasing);
  }
}

TEST(LabLimits, AnEndThatDrivesOnIsFound) {
  Points points = drive(0.0, 0.4);
  points.resize(points.size() / 2);
  EXPECT_EQ(found(points, std::nullopt), TrajectoryFault::kNotStanding);
}

TEST(LabLimits, PositionsBeyondEachSideOfTheAreaAreFound) {
  const Points points = drive(0.0, 0.4, 0.0);
  for (const auto& [bound, value] :
       {std::pair{&LabLimits::x_min_m, 2.3}, std::pair{&LabLimits::x_max_m, 2.9},
        std::pair{&LabLimits::y_min_m, 2.1}, std::pair{&LabLimits::y_max_m, 1.9}}) {
    LabLimits lab = kCpmLab;
    lab.*bound = value;
    EXPECT_EQ(found(points, lab), TrajectoryFault::kOutside) << value;
  }
}

// Between two points at the edge, driven outwards and back.
TEST(LabLimits, ACurveThatLeavesTheAreaBetweenItsPointsIsFound) {
  LabLimits lab = kCpmLab;
  lab.velocity_mismatch_max_mps = 1e3;
  lab.acceleration_max_mps2 = 1e3;
  const Points points{{0.0, {2.0, 3.99}, {0.1, 1.0}},
                      {0.1, {2.01, 3.99}, {0.1, -1.0}},
                      {0.2, {2.02, 3.90}, {0.0, 0.0}}};
  EXPECT_EQ(found(points, lab), TrajectoryFault::kOutside);
}

TEST(LabLimits, TurnsTighterThanTheVehicleAreFoundAndTheSidesDiffer) {
  EXPECT_EQ(found(drive(4.4, 0.4)), TrajectoryFault::kCurvature);
  EXPECT_EQ(found(drive(-4.0, 0.4)), TrajectoryFault::kCurvature);
  EXPECT_EQ(found(drive(4.2, 0.4)), std::nullopt);
  EXPECT_EQ(found(drive(-3.9, 0.4)), std::nullopt);
  EXPECT_EQ(found(drive(9.0, 0.09)), std::nullopt) << "too slow to count";
}

// A drive at 1.2 m/s that begins and ends at once: 1.2 m/s in 50 ms are 24 m/s^2.
TEST(LabLimits, AccelerationsBeyondTheFollowersAreFoundAlongAndAcross) {
  const auto jump = [](double speed_mps) {
    Points points;
    double x_m = 1.0;
    for (int i = 0; i < 40; ++i) {
      const double now = i >= 10 && i < 30 ? speed_mps : 0.0;
      if (i > 0) x_m += 0.05 * 0.5 * (points.back().velocity_mps.x() + now);
      points.push_back({0.05 * i, {x_m, 1.0}, {now, 0.0}});
    }
    return points;
  };
  EXPECT_EQ(found(jump(0.95)), std::nullopt);
  EXPECT_EQ(found(jump(1.2)), TrajectoryFault::kAcceleration);
  EXPECT_EQ(found(drive(4.0, 2.2)), std::nullopt) << "19.4 m/s^2 across";
  EXPECT_EQ(found(drive(4.0, 2.3)), TrajectoryFault::kAcceleration);
}

// A tenth too slow: straight on, and less than half the acceleration that is allowed.
TEST(LabLimits, VelocitiesThatDoNotFitThePositionsAreFound) {
  Points points = drive(0.0, 0.4);
  for (TimedPoint& point : points) point.velocity_mps *= 0.9;
  EXPECT_EQ(found(points), TrajectoryFault::kMismatch);
}

// As if the course were the heading.
TEST(LabLimits, VelocitiesThatPointAsideAreFound) {
  Points points = drive(0.0, 0.4);
  for (TimedPoint& point : points) {
    point.velocity_mps = Eigen::Rotation2Dd(0.12) * point.velocity_mps;
  }
  EXPECT_NE(found(points), std::nullopt);
}

TEST(LabLimits, TurningAndMovingTheCurveChangesNothing) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    Points points = drive(5.0 * unit(random), 1.5 + unit(random));
    points[40].position_m += 0.002 * Point(unit(random), unit(random));
    const auto before = curve_fault(points, kCpmLab);
    const Eigen::Rotation2Dd turn(3.0 * unit(random));
    for (TimedPoint& point : points) {
      point.position_m = turn * point.position_m + Point(3.0, -2.0);
      point.velocity_mps = turn * point.velocity_mps;
    }
    const auto after = curve_fault(points, kCpmLab);
    ASSERT_EQ(before.has_value(), after.has_value());
    if (!before) continue;
    EXPECT_EQ(before->fault, after->fault);
    EXPECT_NEAR(before->value, after->value, 1e-6);
  }
}

TEST(LabLimits, AFaultIsToldWithValueAndBound) {
  const auto fault = trajectory_fault(drive(4.4, 0.4), kCpmLab);
  ASSERT_TRUE(fault);
  EXPECT_THAT(to_text(*fault, kCpmLab),
              testing::AllOf(testing::StartsWith("curvature = 4.3"),
                             testing::EndsWith(" 1/m, must be in -3.96 ... 4.316")));
}

}  // namespace
}  // namespace hlc::vehicle
