#include "planner/road/goal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/num_seeds.hpp"

namespace hlc::road::goal_test {
namespace {

/// A square of 4 m, from its corner at the origin along x; 16 m round.
ReferencePath square(bool closed) {
  return {{{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}}, closed};
}

ConvexPolygon box(double from_x_m, double to_x_m, double from_y_m, double to_y_m) {
  return {{Point(from_x_m, from_y_m), Point(to_x_m, from_y_m), Point(to_x_m, to_y_m),
           Point(from_x_m, to_y_m)}};
}

TEST(FirstStretch, IsWhereThePathEntersTheAreaUntilItLeavesIt) {
  const auto found = first_stretch_in(square(false), box(1.0, 2.5, -0.1, 0.1), 0.5);
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->from_s_m, 1.0);
  EXPECT_DOUBLE_EQ(found->to_s_m, 2.5);
}

TEST(FirstStretch, GoesOnOverAJoint) {
  const auto found = first_stretch_in(square(true), box(3.0, 4.5, -0.1, 1.0), 0.0);
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->from_s_m, 3.0);
  EXPECT_DOUBLE_EQ(found->to_s_m, 5.0);
}

TEST(FirstStretch, OfAnOpenPathIsNotBehindTheStart) {
  EXPECT_FALSE(first_stretch_in(square(false), box(1.0, 2.0, -0.1, 0.1), 3.0));
  EXPECT_FALSE(first_stretch_in(square(false), box(1.0, 2.0, 1.0, 2.0), 0.0));
  EXPECT_FALSE(first_stretch_in(square(false), box(1.0, 2.0, -0.1, 0.1), 1.5)) << "it starts in it";
}

TEST(FirstStretch, OfAClosedPathMayBeInTheNextLap) {
  const auto behind = first_stretch_in(square(true), box(1.0, 2.0, -0.1, 0.1), 3.0);
  ASSERT_TRUE(behind);
  EXPECT_DOUBLE_EQ(behind->from_s_m, 17.0);
  EXPECT_DOUBLE_EQ(behind->to_s_m, 18.0);
  const auto around = first_stretch_in(square(true), box(1.0, 2.0, -0.1, 0.1), 1.5);
  ASSERT_TRUE(around) << "it is entered again after a lap";
  EXPECT_DOUBLE_EQ(around->from_s_m, 17.0);
  EXPECT_DOUBLE_EQ(around->to_s_m, 17.5);
}

TEST(FirstStretch, OfRandomAreasIsInThemAndTheFirst) {
  const ReferencePath path = square(true);
  for (std::uint64_t seed = 1; seed <= test::num_seeds(300); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place_m(-0.5, 4.5);
    std::uniform_real_distribution<double> size_m(0.1, 2.0);
    const ConvexPolygon area_m =
        footprint_area({size_m(random), size_m(random)}, {place_m(random), place_m(random), 0.3});
    const double start_s_m = 3.1 * (place_m(random) + 0.5);
    const auto found = first_stretch_in(path, area_m, start_s_m);
    const double until_s_m = found ? found->from_s_m : start_s_m + path.length_m();
    bool has_left = false;
    const auto steps = static_cast<int>(std::ceil((until_s_m - 1e-6 - start_s_m) / 0.01));
    for (int i = 0; i < steps; ++i) {
      const double s_m = start_s_m + 0.01 * i;
      const bool is_in = contains(area_m, path.at(s_m));
      has_left |= !is_in;
      EXPECT_FALSE(is_in && has_left) << s_m;
    }
    if (!found) continue;
    EXPECT_LE(found->from_s_m, found->to_s_m);
    EXPECT_TRUE(contains(area_m, path.at((found->from_s_m + found->to_s_m) / 2.0), 1e-9));
  }
}

TEST(PathUntil, IsThePathToItsEnd) {
  const ReferencePath cut = path_until(square(true), 6.0);
  EXPECT_FALSE(cut.is_closed());
  EXPECT_DOUBLE_EQ(cut.length_m(), 6.0);
  EXPECT_EQ(cut.at(6.0), Point(4.0, 2.0));
  const ReferencePath at_joint = path_until(square(false), 8.0);
  EXPECT_DOUBLE_EQ(at_joint.length_m(), 8.0);
  EXPECT_EQ(at_joint.points_m().size(), 3U);
  const ReferencePath beyond = path_until(square(true), 17.0);
  EXPECT_DOUBLE_EQ(beyond.length_m(), 17.0);
  EXPECT_EQ(beyond.at(16.5), Point(0.5, 0.0));
}

constexpr Footprint kCar{.length_m = 0.22, .width_m = 0.107};

TEST(Goal, WithoutARegionIsReachedWhereTheFootprintCoversTheEnd) {
  const ReferencePath line({{0.0, 0.0}, {2.0, 0.0}}, false);
  EXPECT_TRUE(is_at_goal(line, {}, 1.9, {1.9, 0.0, 0.0}, kCar));
  EXPECT_FALSE(is_at_goal(line, {}, 1.88, {1.88, 0.0, 0.0}, kCar));
  EXPECT_TRUE(is_at_goal(line, {}, 2.0, {2.05, 0.03, 0.0}, kCar));
  EXPECT_FALSE(is_at_goal(line, {}, 2.0, {2.0, 0.1, 0.0}, kCar));
}

TEST(Goal, OfAPathThatEndsWhereItBeganIsNotReachedAtItsBegin) {
  const ReferencePath loop({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}, {0.0, 0.0}}, false);
  EXPECT_FALSE(is_at_goal(loop, {}, 0.0, {}, kCar));
  EXPECT_TRUE(is_at_goal(loop, {}, 16.0, {}, kCar));
  EXPECT_FALSE(is_at_goal(square(true), {}, 16.0, {}, kCar)) << "a closed path has no end";
}

TEST(Goal, WithARegionIsReachedAnywhereInItAtTheEndOfThePath) {
  const ReferencePath line({{0.0, 0.0}, {2.0, 0.0}}, false);
  const Goal goal{.area_m = box(1.5, 2.5, -0.2, 0.2), .from_s_m = 1.5};
  EXPECT_TRUE(is_at_goal(line, goal, 1.6, {1.6, 0.15, 0.0}, kCar));
  EXPECT_FALSE(is_at_goal(line, goal, 1.4, {1.4, 0.0, 0.0}, kCar));
  EXPECT_FALSE(is_at_goal(line, goal, 1.6, {1.6, 0.25, 0.0}, kCar));
  EXPECT_FALSE(is_at_goal(line, goal, 0.3, {1.6, 0.0, 0.0}, kCar)) << "another strand of the path";
}

// The places where a car can stand are some centimetres apart.
TEST(Goal, WithARegionTooSmallToStandInIsReachedWhereTheFootprintCoversItsMiddle) {
  const ReferencePath line({{0.0, 0.0}, {2.0, 0.0}}, false);
  const Goal goal{.area_m = box(1.99, 2.01, -0.01, 0.01), .from_s_m = 1.99};
  EXPECT_TRUE(is_at_goal(line, goal, 1.93, {1.93, 0.03, 0.0}, kCar));
  EXPECT_FALSE(is_at_goal(line, goal, 1.85, {1.85, 0.0, 0.0}, kCar));
}

}  // namespace
}  // namespace hlc::road::goal_test
