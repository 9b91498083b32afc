#include "planner/road/lap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/num_seeds.hpp"

namespace hlc::road {
namespace {

constexpr double kPi = std::numbers::pi;

ReferencePath circle(double radius_m, std::size_t points = 3600) {
  std::vector<Point> points_m;
  for (std::size_t i = 0; i < points; ++i) {
    const double angle = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(points);
    points_m.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle));
  }
  return {points_m, true};
}

/// A narrow loop: there and back, the two strands `width_m` apart.
ReferencePath hairpin(double length_m, double width_m) {
  return {{{0, 0}, {length_m, 0}, {length_m, width_m}, {0, width_m}}, true};
}

std::vector<double> times(std::size_t count, double step_s) {
  std::vector<double> times_s;
  for (std::size_t i = 0; i < count; ++i) {
    times_s.push_back(static_cast<double>(i) * step_s);
  }
  return times_s;
}

TEST(Lap, CircleAtConstantSpeedTakesItsLengthOverTheSpeed) {
  const ReferencePath path = circle(1.0);
  for (const double start_rad : {0.0, 1.0, 6.2}) {
    std::vector<Point> positions_m;
    for (int i = 0; i <= 60; ++i) {
      const double angle = start_rad + 0.8 * 0.2 * i;
      positions_m.emplace_back(std::cos(angle), std::sin(angle));
    }
    const Progress progress = progress_along(path, positions_m);
    const auto lap = lap_s(path, progress, times(positions_m.size(), 0.2));
    ASSERT_TRUE(lap) << start_rad;
    EXPECT_NEAR(*lap, 2.0 * kPi / 0.8, 1e-4) << start_rad;
  }
}

TEST(Lap, CountsTimeNotRows) {
  const ReferencePath path = circle(1.0);
  std::vector<Point> positions_m;
  std::vector<double> times_s;
  for (int i = 0; i <= 60; ++i) {
    if (i % 7 == 3) {
      continue;  // a step without report
    }
    positions_m.emplace_back(std::cos(0.16 * i), std::sin(0.16 * i));
    times_s.push_back(0.2 * i);
  }
  EXPECT_NEAR(lap_s(path, progress_along(path, positions_m), times_s).value(), 2.0 * kPi / 0.8,
              1e-4);
}

TEST(Lap, CountsFromWhereTheCarFirstMoves) {
  const ReferencePath path = circle(1.0);
  std::vector<Point> positions_m{{1.0, 0.0}};
  for (int i = 0; i <= 60; ++i) positions_m.emplace_back(std::cos(0.16 * i), std::sin(0.16 * i));
  const Progress progress = progress_along(path, positions_m);
  const std::vector<double> times_s = times(positions_m.size(), 0.2);
  EXPECT_NEAR(lap_s(path, progress, times_s).value(), 2.0 * kPi / 0.8 + 0.2, 1e-4);
  EXPECT_NEAR(lap_s(path, progress, times_s, 1).value(), 2.0 * kPi / 0.8, 1e-4);
}

TEST(Lap, IsNotCompletedAMillimetreBeforeTheStart) {
  const ReferencePath path = circle(1.0);
  std::vector<Point> positions_m;
  for (int i = 0; i <= 30; ++i) {
    const double angle = (2.0 * kPi - 0.001) * i / 30.0;
    positions_m.emplace_back(std::cos(angle), std::sin(angle));
  }
  const Progress progress = progress_along(path, positions_m);
  EXPECT_FALSE(lap_s(path, progress, times(positions_m.size(), 0.2)));
  EXPECT_NEAR(progress.s_m.back() - progress.s_m.front(), path.length_m() - 0.001, 1e-4);
}

TEST(Lap, OpenPathHasNone) {
  const ReferencePath path{{{0, 0}, {1, 0}}, false};
  const std::vector<Point> positions_m{{0, 0}, {0.5, 0}, {1, 0}};
  EXPECT_FALSE(lap_s(path, progress_along(path, positions_m), times(3, 0.2)));
}

TEST(Progress, StaysOnItsStrandWhereAnotherPassesCloseBy) {
  const ReferencePath path = hairpin(3.0, 0.3);
  std::vector<Point> positions_m;
  for (int i = 0; i <= 15; ++i) {
    // Drifts 0.2 m to the side: nearer to the way back than to the way there.
    positions_m.emplace_back(0.5 + 0.1 * i, std::min(0.2, 0.04 * i));
  }
  const Progress progress = progress_along(path, positions_m);
  EXPECT_NEAR(progress.s_m.back(), 2.0, 1e-9);
  EXPECT_NEAR(progress.distance_m.back(), 0.2, 1e-9);
}

// Property: along a smooth closed path, with offsets to both sides, progress equals the arc length
// of the foot, unwrapped over several laps.
TEST(Progress, IsTheUnwrappedArcLengthOfTheFoot) {
  for (unsigned seed = 0; seed < test::num_seeds(50); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> unit{0.0, 1.0};
    const double radius_m = 0.5 + unit(random);
    const ReferencePath path = circle(radius_m, 7200);
    std::vector<Point> positions_m;
    std::vector<double> feet_m;
    double angle = 6.0 * unit(random);
    for (int i = 0; i < 100; ++i) {
      const double offset_m = 0.15 * (2.0 * unit(random) - 1.0);
      positions_m.emplace_back((radius_m + offset_m) * std::cos(angle),
                               (radius_m + offset_m) * std::sin(angle));
      feet_m.push_back(radius_m * angle);
      angle += 0.16 * unit(random) / radius_m;
    }
    const Progress progress = progress_along(path, positions_m);
    for (std::size_t i = 0; i < feet_m.size(); ++i) {
      EXPECT_NEAR(progress.s_m[i] - progress.s_m[0], feet_m[i] - feet_m[0], 1e-3) << i;
    }
  }
}

}  // namespace
}  // namespace hlc::road
