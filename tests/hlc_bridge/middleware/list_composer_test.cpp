#include "hlc_bridge/middleware/list_composer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hlc_bridge/middleware/middleware_in_memory.hpp"

namespace hlc::middleware {
namespace {

using test::run_parameters;

using test::kMs;
using testing::ElementsAre;

TEST(ListComposer, HoldsTheNewestValidStateOfEveryActiveVehicle) {
  ListComposer composer{false};
  for (const Nanoseconds create : {100 * kMs, 140 * kMs, 160 * kMs}) {
    composer.add(2, test::state(2, create));
  }
  EXPECT_EQ(composer.newest_list(), 0U);
  EXPECT_TRUE(composer.holds_state(2, 160 * kMs));
  EXPECT_FALSE(composer.holds_state(2, 180 * kMs));
  EXPECT_FALSE(composer.holds_state(1, 0));
  const VehicleStateList list =
      composer.compose(200 * kMs + kListOffset, run_parameters(200, {1, 2}));
  EXPECT_EQ(list.t_now, 200 * kMs + kListOffset);
  EXPECT_EQ(composer.newest_list(), list.t_now);
  EXPECT_EQ(list.period_ms, 200U);
  EXPECT_THAT(list.active_vehicle_ids, ElementsAre(1, 2));
  ASSERT_EQ(list.states.size(), 2U);
  EXPECT_EQ(list.states[0].vehicle_id, 0) << "no state yet: a placeholder";
  EXPECT_EQ(list.states[1].create_stamp, 140 * kMs);
  EXPECT_TRUE(list.observations.empty());
}

TEST(ListComposer, ObservationsStandInTheOrderOfTheActiveVehicles) {
  ListComposer composer{true};
  composer.add(1, VehicleObservation{.vehicle_id = 1, .create_stamp = 7, .pose = {.x_m = 1.0}});
  composer.add(1, VehicleObservation{.vehicle_id = 1, .create_stamp = 6, .pose = {.x_m = 2.0}});
  composer.add(3, VehicleObservation{.vehicle_id = 3, .create_stamp = 7, .pose = {.x_m = 3.0}});
  composer.add(3, VehicleObservation{.vehicle_id = 3, .create_stamp = 7, .pose = {.x_m = 4.0}});
  const VehicleStateList list = composer.compose(kListOffset, run_parameters(200, {3, 2, 1}));
  ASSERT_EQ(list.observations.size(), 3U);
  EXPECT_EQ(list.observations[0].pose.x_m, 4.0) << "the later arrival among equals";
  EXPECT_EQ(list.observations[1].vehicle_id, 0) << "none: a placeholder";
  EXPECT_EQ(list.observations[2].pose.x_m, 1.0) << "the newest, whenever it arrived";
}

}  // namespace
}  // namespace hlc::middleware
