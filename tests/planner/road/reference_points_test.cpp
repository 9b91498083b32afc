#include "planner/road/reference_points.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hlc::road {
namespace {

const ReferencePath kStraight({{0.0, 0.0}, {10.0, 0.0}}, false);
const ReferencePath kSquarePath({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, true);

TEST(ReferencePoints, MeanSpeedFirstStartsWithTheMeanOfCurrentAndReferenceSpeed) {
  const Reference reference = reference_points(kStraight, 1.0, 0.4, 0.8, 3, 0.2, mean_speed_first);
  ASSERT_EQ(reference.points_m.size(), 3U);
  EXPECT_NEAR(reference.points_m[0].x(), 1.0 + 0.12, 1e-12);
  EXPECT_NEAR(reference.points_m[1].x(), 1.0 + 0.28, 1e-12);
  EXPECT_NEAR(reference.points_m[2].x(), 1.0 + 0.44, 1e-12);
  ASSERT_EQ(reference.speeds_mps.size(), 3U);
  EXPECT_DOUBLE_EQ(reference.speeds_mps[0], 0.6);
  EXPECT_DOUBLE_EQ(reference.speeds_mps[1], 0.8);
  EXPECT_DOUBLE_EQ(reference.speeds_mps[2], 0.8);
}

TEST(ReferencePoints, HalfSpeedLastHalvesTheLastStepAndIgnoresTheCurrentSpeed) {
  const Reference reference = reference_points(kStraight, 0.0, 0.1, 0.8, 8, 0.2, half_speed_last);
  ASSERT_EQ(reference.points_m.size(), 8U);
  EXPECT_NEAR(reference.points_m[0].x(), 0.16, 1e-12);
  EXPECT_NEAR(reference.points_m[6].x(), 7 * 0.16, 1e-12);
  EXPECT_NEAR(reference.points_m[7].x(), 7.5 * 0.16, 1e-12);
  EXPECT_DOUBLE_EQ(reference.speeds_mps[6], 0.8);
  EXPECT_DOUBLE_EQ(reference.speeds_mps[7], 0.4);
}

TEST(ReferencePoints, GoRoundACircuit) {
  const Reference reference =
      reference_points(kSquarePath, 3.9, 1.0, 1.0, 2, 0.2, mean_speed_first);
  EXPECT_NEAR((reference.points_m[0] - Point(0.1, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((reference.points_m[1] - Point(0.3, 0.0)).norm(), 0.0, 1e-12);
}

TEST(ReferencePoints, WaitAtTheEndOfAnOpenPath) {
  const Reference reference = reference_points(kStraight, 9.9, 1.0, 1.0, 3, 0.2, mean_speed_first);
  EXPECT_EQ(reference.points_m[0], Point(10.0, 0.0));
  EXPECT_EQ(reference.points_m[2], Point(10.0, 0.0));
}

TEST(ReferencePoints, AreSlowInTheStepThatEntersASlowSection) {
  const std::vector<SpeedSection> sections{{0.4, 0.55, 0.3}};
  const Reference reference =
      reference_points(kStraight, 0.0, 0.8, 0.8, 6, 0.2, half_speed_last, sections);
  // Whole steps of 0.16 m end at 0.16 and 0.32 m; the next would enter the section.
  const std::vector<double> expected_mps{0.8, 0.8, 0.3, 0.3, 0.3, 0.15};
  EXPECT_EQ(reference.speeds_mps, expected_mps);
  EXPECT_NEAR(reference.points_m[5].x(), 0.32 + 3 * 0.06 + 0.03, 1e-12);
}

TEST(ReferencePoints, AreFastAgainBehindTheSection) {
  const std::vector<SpeedSection> sections{{0.0, 0.1, 0.3}};
  const Reference reference =
      reference_points(kStraight, 0.0, 0.8, 0.8, 4, 0.2, mean_speed_first, sections);
  const std::vector<double> expected_mps{0.55, 0.8, 0.8, 0.8};
  EXPECT_EQ(reference.speeds_mps, expected_mps);
}

}  // namespace
}  // namespace hlc::road
