#include "hlc_bridge/messages/settled_states.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hlc::settled_states_test {
namespace {

VehicleState state_at(Nanoseconds create, double x_m = 1.0) {
  VehicleState state{.vehicle_id = 1, .create_stamp = create};
  state.pose.x_m = x_m;
  return state;
}

/// Standing states at every vehicle tick in [from, to].
void add_standing(SettledStates& states, Nanoseconds from, Nanoseconds to) {
  for (Nanoseconds t = from; t <= to; t += kVehiclePeriod) states.add(state_at(t));
}

TEST(SettledStates, OneSecondOfThemSettlesAndNoLess) {
  SettledStates states;
  EXPECT_FALSE(states.have_settled());
  add_standing(states, 40 * kVehiclePeriod, 89 * kVehiclePeriod);
  EXPECT_FALSE(states.have_settled());
  states.add(state_at(90 * kVehiclePeriod));
  EXPECT_TRUE(states.have_settled());
}

TEST(SettledStates, AJumpAPauseANanAStepBackOrALostPositionBeginsANewSecond) {
  const Nanoseconds next = 51 * kVehiclePeriod;
  VehicleState broken = state_at(next);
  broken.speed_mps = std::numeric_limits<double>::quiet_NaN();
  VehicleState unseen = state_at(next);
  unseen.ips_update_age = kMaxPositionAge + 1;
  for (const VehicleState& odd :
       {state_at(next, 1.2), state_at(50 * kVehiclePeriod + SettledStates::kMostPause + 1), broken,
        unseen, state_at(49 * kVehiclePeriod)}) {
    SettledStates states;
    add_standing(states, 0, 50 * kVehiclePeriod);
    ASSERT_TRUE(states.have_settled());
    states.add(odd);
    EXPECT_FALSE(states.have_settled());
    const Nanoseconds again = odd.create_stamp + kVehiclePeriod;
    add_standing(states, again, again + 48 * kVehiclePeriod);
    EXPECT_FALSE(states.have_settled()) << odd.create_stamp;
    add_standing(states, again + 49 * kVehiclePeriod, again + 52 * kVehiclePeriod);
    EXPECT_TRUE(states.have_settled());
  }
}

TEST(SettledStates, ADrivingVehicleAndRepeatedStatesDoNotDisturb) {
  SettledStates states;
  for (int i = 0; i <= 50; ++i) {
    const auto t = static_cast<Nanoseconds>(i) * kVehiclePeriod;
    states.add(state_at(t, 4.0 * 1e-9 * static_cast<double>(t)));
    states.add(state_at(t, 4.0 * 1e-9 * static_cast<double>(t)));
  }
  EXPECT_TRUE(states.have_settled());
}

TEST(SettledStates, AVehicleThatWasNeverLocatedDoesNotSettle) {
  // In logical time, too, where its clock and so its position's age begins at nothing.
  SettledStates states;
  for (Nanoseconds t = 0; t <= 3 * kNanosecondsPerSecond; t += kVehiclePeriod) {
    VehicleState state = state_at(t);
    state.ips_update_age = t;
    states.add(state);
    ASSERT_FALSE(states.have_settled()) << t;
  }
}

}  // namespace
}  // namespace hlc::settled_states_test
