#include "hlc_bridge/middleware/state_buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

#include "tests/support/num_seeds.hpp"

namespace hlc::middleware::state_buffer_test {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

VehicleState state(std::uint8_t id, Nanoseconds create, double x_m = 0.0) {
  VehicleState state;
  state.vehicle_id = id;
  state.create_stamp = create;
  state.valid_after_stamp = create + kStateDelay;
  state.pose.x_m = x_m;
  return state;
}

TEST(StateBuffer, NewestValidStateIsTheOneWithTheLargestCreateStampInForce) {
  StateBuffer buffer;
  for (const Nanoseconds create : {0 * kMs, 20 * kMs, 40 * kMs, 60 * kMs}) {
    buffer.add(1, state(1, create));
  }
  EXPECT_EQ(buffer.newest_valid(1, 100 * kMs + 1)->create_stamp, 40 * kMs);
  EXPECT_EQ(buffer.newest_valid(1, 100 * kMs)->create_stamp, 40 * kMs);
  EXPECT_EQ(buffer.newest_valid(1, 100 * kMs - 1)->create_stamp, 20 * kMs);
}

TEST(StateBuffer, NothingIsValidBeforeTheDelay) {
  StateBuffer buffer;
  buffer.add(1, state(1, 0));
  EXPECT_EQ(buffer.newest_valid(1, kStateDelay - 1), nullptr);
  EXPECT_EQ(buffer.newest_valid(2, kStateDelay), nullptr);
}

TEST(StateBuffer, LaterArrivalWinsAmongEqualStamps) {
  StateBuffer buffer;
  buffer.add(1, state(1, 0, 1.0));
  buffer.add(1, state(1, 0, 2.0));
  EXPECT_EQ(buffer.newest_valid(1, kStateDelay)->pose.x_m, 2.0);
}

TEST(StateBuffer, HoldsAStampOnceThatOrALaterOneHasArrived) {
  StateBuffer buffer;
  EXPECT_FALSE(buffer.holds(1, 0));
  buffer.add(1, state(1, 20 * kMs));
  EXPECT_TRUE(buffer.holds(1, 0));
  EXPECT_TRUE(buffer.holds(1, 20 * kMs));
  EXPECT_FALSE(buffer.holds(1, 40 * kMs));
  EXPECT_FALSE(buffer.holds(2, 0));
}

// Property: whatever the order of arrival and whenever old ones are forgotten, the answer is that
// of a search through all states ever sent.
TEST(StateBuffer, OrderOfArrivalAndForgettingChangeNoAnswer) {
  for (unsigned seed = 0; seed < test::num_seeds(200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random{seed};
    std::vector<VehicleState> sent;
    for (Nanoseconds i = 0; i < 30; ++i) {
      sent.push_back(state(1, i * kVehiclePeriod));
    }
    std::vector<VehicleState> arriving = sent;
    for (std::size_t i = 0; i + 1 < arriving.size(); ++i) {  // neighbours change places
      if (random() % 2 == 0) {
        std::swap(arriving[i], arriving[i + 1]);
      }
    }
    StateBuffer buffer;
    std::vector<VehicleState> arrived;
    Nanoseconds t_now = 0;
    for (const VehicleState& next : arriving) {
      buffer.add(1, next);
      arrived.push_back(next);
      t_now = std::max(t_now, next.create_stamp + random() % (100 * kMs));
      std::optional<Nanoseconds> expected;
      for (const VehicleState& old : arrived) {
        if (old.valid_after_stamp <= t_now && (!expected || old.create_stamp > *expected)) {
          expected = old.create_stamp;
        }
      }
      const VehicleState* newest = buffer.newest_valid(1, t_now);
      ASSERT_EQ(newest != nullptr, expected.has_value());
      if (newest != nullptr) {
        ASSERT_EQ(newest->create_stamp, *expected);
      }
      if (random() % 3 == 0) {
        buffer.forget_before(t_now);
      }
    }
  }
}

TEST(StateBuffer, KeepsABoundedNumberOfStates) {
  StateBuffer buffer;
  for (Nanoseconds i = 0; i < 3 * StateBuffer::kCapacity; ++i) {
    buffer.add(1, state(1, i));
  }
  EXPECT_EQ(buffer.newest_valid(1, kStateDelay + 3 * StateBuffer::kCapacity)->create_stamp,
            3 * StateBuffer::kCapacity - 1);
  EXPECT_EQ(buffer.newest_valid(1, kStateDelay + 2 * StateBuffer::kCapacity - 1), nullptr);
}

TEST(StateList, ActiveVehicleWithoutStateIsAPlaceholderWithIdZero) {
  StateBuffer buffer;
  buffer.add(2, state(2, 0, 3.5));
  const std::vector<std::int32_t> active{1, 2};
  const VehicleStateList list = compose_state_list(buffer, 200 * kMs + 1, 200 * kMs, active);
  EXPECT_EQ(list.t_now, 200 * kMs + 1);
  EXPECT_EQ(list.period_ms, 200U);
  EXPECT_EQ(list.active_vehicle_ids, active);
  ASSERT_EQ(list.states.size(), 2U);
  EXPECT_EQ(list.states[0].vehicle_id, 0U);
  EXPECT_EQ(list.states[1].vehicle_id, 2U);
  EXPECT_EQ(list.states[1].pose.x_m, 3.5);
}

TEST(StateList, RepeatsTheLastStateOfASilentVehicle) {
  StateBuffer buffer;
  buffer.add(1, state(1, 20 * kMs));
  const std::vector<std::int32_t> active{1};
  for (const Nanoseconds t_now : {200 * kMs + 1, 400 * kMs + 1, 4000 * kMs + 1}) {
    buffer.forget_before(t_now);
    EXPECT_EQ(compose_state_list(buffer, t_now, 200 * kMs, active).states[0].create_stamp,
              20 * kMs);
  }
}

}  // namespace
}  // namespace hlc::middleware::state_buffer_test
