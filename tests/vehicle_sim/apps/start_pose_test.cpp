#include "vehicle_sim/apps/start_pose.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace hlc::apps {
namespace {

TEST(StartPose, VehiclesWithAStartOfTheirOwnStandInTheLabClearOfEachOther) {
  for (std::uint8_t a = 1; a <= kLastDefaultStart; ++a) {
    const Pose pose = start_pose(a, {});
    EXPECT_GT(pose.x_m, 0.2);
    EXPECT_LT(pose.x_m, 4.3);
    EXPECT_GT(pose.y_m, 0.2);
    EXPECT_LT(pose.y_m, 3.8);
    for (std::uint8_t b = 1; b < a; ++b) {
      EXPECT_GT((start_pose(b, {}).position_m() - pose.position_m()).norm(), 0.5);
    }
  }
}

TEST(StartPose, GivenPoseIsTaken) {
  EXPECT_EQ(start_pose(30, {1.0, 2.0, -0.5}), (Pose{.x_m = 1.0, .y_m = 2.0, .heading_rad = -0.5}));
}

TEST(StartPose, IdsAboveTheListNeedAPose) {
  EXPECT_NO_THROW(static_cast<void>(start_pose(23, {})));
  EXPECT_THROW(static_cast<void>(start_pose(24, {})), std::invalid_argument);
}

TEST(StartPose, NumbersThatMakeNoPoseAreRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(start_pose(1, {1.0, 2.0})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(start_pose(1, {1.0, 2.0, 3.0, 4.0})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(start_pose(1, {1.0, kNan, 3.0})), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::apps
