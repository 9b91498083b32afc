#include "hlc_bridge/hlc/observation.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hlc::high_level_controller::observation_test {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

VehicleStateList list_at(Nanoseconds t_now, std::vector<VehicleState> states) {
  return {.t_now = t_now,
          .period_ms = 200,
          .states = std::move(states),
          .observations = {},
          .active_vehicle_ids = {3, 1}};
}

VehicleState state(std::uint8_t id, Nanoseconds create) {
  VehicleState result;
  result.vehicle_id = id;
  result.create_stamp = create;
  result.valid_after_stamp = create + kStateDelay;
  result.pose = {1.0, 2.0, 3.0};
  return result;
}

TEST(Observation, StepsAreNumberedByTimeNotByReceipt) {
  EXPECT_EQ(step_of(list_at(1, {})), StepIndex{0});
  EXPECT_EQ(step_of(list_at(1'000 * kMillisecond + 1, {})), StepIndex{5});
  EXPECT_EQ(step_of(list_at(1'199 * kMillisecond, {})), StepIndex{5});
}

TEST(Observation, DeadlinesLieBetweenTheListAndTheEndOfItsStep) {
  EXPECT_EQ(deadline_in_step(list_at(1'000 * kMillisecond, {}), 0.2), 1'040 * kMillisecond);
  // A list late in its period leaves less time, but some.
  EXPECT_EQ(deadline_in_step(list_at(1'150 * kMillisecond, {}), 0.2), 1'160 * kMillisecond);
  EXPECT_EQ(deadline_in_step(list_at(1'150 * kMillisecond, {}), 0.9), 1'195 * kMillisecond);
}

TEST(Observation, APlaceholderIsNotAVehicleAtTheOrigin) {
  const controller::Observation observation =
      observation_of(list_at(1'000 * kMillisecond + 1, {state(0, 0)}), 0.0);
  EXPECT_TRUE(observation.states.empty());
  EXPECT_FALSE(is_complete(observation));
}

TEST(Observation, StaleInvalidAndBrokenStatesAreNotUsed) {
  const Nanoseconds now = 1'000 * kMillisecond + 1;
  EXPECT_TRUE(is_usable(state(1, 940 * kMillisecond), now));
  EXPECT_FALSE(is_usable(state(1, 799 * kMillisecond), now)) << "older than 0.2 s";
  EXPECT_FALSE(is_usable(state(1, 960 * kMillisecond), now)) << "not yet valid";
  VehicleState broken = state(1, 940 * kMillisecond);
  broken.pose.y_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_usable(broken, now));
}

TEST(Observation, AStateWhosePositionWasNotMeasuredForLongIsNotUsed) {
  const Nanoseconds now = 1'000 * kMillisecond + 1;
  VehicleState reckoned = state(1, 940 * kMillisecond);
  reckoned.ips_update_age = 500 * kMillisecond;
  EXPECT_TRUE(is_usable(reckoned, now));
  // The last one: of a vehicle that was never located, by a clock of our time.
  for (const Nanoseconds age : {500 * kMillisecond + 1, 1'700'000'000'000 * kMillisecond}) {
    reckoned.ips_update_age = age;
    EXPECT_FALSE(is_usable(reckoned, now)) << age;
  }
}

TEST(Observation, TheAgeIsThatAtTheBeginOfTheStep) {
  const controller::Observation observation =
      observation_of(list_at(1'000 * kMillisecond + 1, {state(1, 940 * kMillisecond)}), 0.0);
  ASSERT_EQ(observation.states.size(), 1U);
  EXPECT_NEAR(observation.states[0].age_s, 0.06, 1e-12);
}

TEST(Observation, APoseHasTheLeadOfItsLab) {
  const VehicleStateList list = list_at(1'000 * kMillisecond + 1, {state(1, 940 * kMillisecond)});
  const coordination::MeasuredVehicle seen = observation_of(list, 0.02).states.at(0);
  EXPECT_EQ(seen.pose_lead_s, 0.02);
  EXPECT_NEAR(seen.age_s, 0.06, 1e-12) << "that of the stamp: what is not known of the lead counts";
}

TEST(Observation, CompleteMeansAUsableStateOfEveryActiveVehicle) {
  const Nanoseconds now = 1'000 * kMillisecond + 1;
  const auto both = list_at(now, {state(3, 940 * kMillisecond), state(1, 940 * kMillisecond)});
  const controller::Observation observation = observation_of(both, 0.0);
  EXPECT_TRUE(is_complete(observation));
  EXPECT_EQ(observation.active, (std::vector<VehicleId>{{1}, {3}}));
  EXPECT_FALSE(is_complete(observation_of(list_at(now, {state(3, 940 * kMillisecond)}), 0.0)));
}

}  // namespace
}  // namespace hlc::high_level_controller::observation_test
