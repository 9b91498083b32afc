#include "vehicle_sim/apps/start_pose.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::apps {
namespace {

TEST(StartPose, VehiclesWithAStartOfTheirOwnStandInTheLabClearOfEachOther) {
  for (std::uint8_t a = 1; a <= kLastDefaultStart; ++a) {
    const Pose pose = start_pose(a, {});
    EXPECT_GT(pose.x_m, 0.1);
    EXPECT_LT(pose.x_m, 4.4);
    EXPECT_GT(pose.y_m, 0.1);
    EXPECT_LT(pose.y_m, 3.9);
    for (std::uint8_t b = 1; b < a; ++b) {
      EXPECT_GT((start_pose(b, {}).position_m() - pose.position_m()).norm(), 0.4);
    }
  }
}

TEST(StartPose, OneToFourAreTheStartsOfTheScenarioLabRing) {
  const scenario::Scenario ring = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_ring.yaml"});
  ASSERT_EQ(ring.vehicles.size(), 4U);
  for (const scenario::ScenarioVehicle& vehicle : ring.vehicles) {
    const Pose pose = start_pose(vehicle.id.value, {});
    EXPECT_LT((pose.position_m() - vehicle.start.position_m()).norm(), 0.01) << vehicle.name;
    const auto controller = scenario::make_controller(ring, vehicle.id);
    static_cast<void>(controller->stand_by(
        {.step = {1}, .active = {vehicle.id}, .states = {{.vehicle = vehicle.id, .pose = pose}}}));
    EXPECT_TRUE(controller->fits_route()) << vehicle.name;
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
