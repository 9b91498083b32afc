#include "hlc_bridge/messages/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/support/num_seeds.hpp"

namespace hlc::validate_test {
namespace {

constexpr Nanoseconds kPeriod = 200 * kNanosecondsPerMillisecond;
constexpr Nanoseconds kLast = ~Nanoseconds{};

TEST(RequestId, MayNotBeATimeOfTheFuture) {
  constexpr Nanoseconds kNow = 1'000 * kNanosecondsPerSecond;
  for (const std::uint64_t id : {std::uint64_t{0}, kNow, kNow + kMostLead}) {
    EXPECT_TRUE(is_plausible_request_id(id, kNow)) << id;
  }
  for (const std::uint64_t id : {kNow + kMostLead + 1, std::numeric_limits<std::uint64_t>::max()}) {
    EXPECT_FALSE(is_plausible_request_id(id, kNow)) << id;
  }
}

TEST(PlausibleStamp, LiesAtMostASecondAndAPeriodAhead) {
  const Instant now{.run = 5 * kNanosecondsPerSecond};
  for (const Nanoseconds stamp : {Nanoseconds{0}, now.run, now.run + kMostLead + kPeriod}) {
    EXPECT_TRUE(is_plausible_stamp(stamp, now, kPeriod)) << stamp;
  }
  for (const Nanoseconds stamp : {now.run + kMostLead + kPeriod + 1, kLast}) {
    EXPECT_FALSE(is_plausible_stamp(stamp, now, kPeriod)) << stamp;
  }
}

TEST(PlausibleStamp, IsAnyBeforeTheFirstTickOfLogicalTime) {
  EXPECT_TRUE(is_plausible_stamp(kLast, {.has_begun = false}, kPeriod));
  EXPECT_FALSE(is_plausible_stamp(kLast, {.has_begun = true}, kPeriod));
}

// --- areas --------------------------------------------------------------------------------------

const ConvexPolygon kSquare{{Point{0, 0}, Point{1, 0}, Point{1, 1}, Point{0, 1}}};

ConvexPolygon star(int corners, int stride) {
  ConvexPolygon result;
  for (int i = 0; i < corners; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i * stride / corners;
    result.vertices_m.emplace_back(std::cos(angle_rad), std::sin(angle_rad));
  }
  return result;
}

TEST(ValidArea, IsConvexAndCounterClockwiseOrEmpty) {
  EXPECT_TRUE(is_valid_area({}));
  EXPECT_TRUE(is_valid_area(kSquare));
  EXPECT_TRUE(is_valid_area(star(7, 1)));
  EXPECT_TRUE(is_valid_area({{Point{0, 0}, Point{1, 0}, Point{1, 0}, Point{0, 1}, Point{0, 0}}}))
      << "repeated corners";
  EXPECT_TRUE(is_valid_area({{Point{0, 0}, Point{0.5, 0}, Point{1, 0}, Point{0, 1}}}))
      << "three corners on a line";
}

TEST(ValidArea, IsNeitherClockwiseNorCrossedNorDentedNorFlat) {
  ConvexPolygon clockwise = kSquare;
  std::ranges::reverse(clockwise.vertices_m);
  EXPECT_FALSE(is_valid_area(clockwise));
  EXPECT_FALSE(is_valid_area({{Point{0, 0}, Point{1, 0}, Point{0, 1}, Point{1, 1}}})) << "bow tie";
  EXPECT_FALSE(is_valid_area({{Point{0, 0}, Point{1, 0}, Point{0.1, 0.1}, Point{0, 1}}})) << "dent";
  EXPECT_FALSE(is_valid_area(star(5, 2))) << "left turns only, twice around";
  EXPECT_FALSE(is_valid_area({{Point{0, 0}, Point{1, 0}, Point{2, 0}}})) << "flat";
  EXPECT_FALSE(is_valid_area({{Point{0, 0}, Point{1, 0}}}));
  EXPECT_FALSE(is_valid_area({{Point{0, 0}, Point{2, 0}, Point{1, 0}, Point{1, 1}}})) << "spike";
}

TEST(ValidArea, MayBeDentedByTheToleranceOnly) {
  const auto dented = [](double by_m) {
    return ConvexPolygon{{Point{0, 0}, Point{1, by_m}, Point{2, 0}, Point{1, 1}}};
  };
  EXPECT_TRUE(is_valid_area(dented(0.9 * kConvexTolerance_m)));
  EXPECT_FALSE(is_valid_area(dented(1.1 * kConvexTolerance_m)));
}

TEST(ValidArea, HasFiniteCoordinatesUpToTheLargest) {
  for (const double far_m : {1.001 * kLargestCoordinate_m, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(is_valid_area({{Point{0, 0}, Point{far_m, 0}, Point{0, 1}}})) << far_m;
    EXPECT_FALSE(is_valid_area({{Point{0, 0}, Point{1, 0}, Point{0, far_m}}})) << far_m;
  }
  EXPECT_TRUE(is_valid_area({{Point{0, 0}, Point{kLargestCoordinate_m, 0}, Point{0, 1}}}));
}

TEST(ValidArea, IsEveryHullGrownSimplifiedAndRotated) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(1000); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto number = [&](double most) {
      return std::uniform_real_distribution{-most, most}(random);
    };
    std::vector<Point> points;
    const std::size_t n = std::uniform_int_distribution<std::size_t>{3, 40}(random);
    for (std::size_t i = 0; i < n; ++i) points.emplace_back(number(1.0), number(0.1));
    const ConvexPolygon hull = convex_hull(points);
    const Pose frame{number(1000.0), number(1000.0), number(std::numbers::pi)};
    EXPECT_TRUE(is_valid_area(hull));
    EXPECT_TRUE(is_valid_area(transformed(hull, frame)));
    EXPECT_TRUE(is_valid_area(transformed(inflated(hull, 0.02), frame)));
    EXPECT_TRUE(is_valid_area(transformed(simplified_outwards(hull, 8), frame)));
  }
}

}  // namespace
}  // namespace hlc::validate_test
