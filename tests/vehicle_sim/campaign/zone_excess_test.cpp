#include "vehicle_sim/campaign/zone_excess.hpp"

#include <gtest/gtest.h>

namespace hlc::campaign::zone_excess_test {
namespace {

constexpr Nanoseconds kTick = 20'000'000;

const std::vector<policy::SpeedZone> kZones{
    {.min_x_m = 1.0, .max_x_m = 2.0, .min_y_m = -1.0, .max_y_m = 1.0, .max_speed_mps = 0.6},
    {.min_x_m = 1.5, .max_x_m = 2.0, .min_y_m = -1.0, .max_y_m = 1.0, .max_speed_mps = 0.4}};

/// One step of ten ticks, from t = 0.2 s on.
const result::RunFacts kFacts{.period = 10 * kTick, .steps = 1, .first_step = 1};

/// Tick i is at 0.2 s + i * 20 ms.
result::Drive drive(const std::vector<std::pair<double, double>>& x_and_speed) {
  result::Drive drive;
  for (const auto& [x_m, speed_mps] : x_and_speed) {
    drive.push_back(
        {.t = 10 * kTick + drive.size() * kTick, .pose = {x_m, 0.0, 0.0}, .speed_mps = speed_mps});
  }
  return drive;
}

TEST(ZoneExcess, IsTheShareOfTheTimeOfAllVehiclesInZones) {
  const result::Drives drives{
      {1, drive({{0.5, 2.0}, {1.2, 0.6}, {1.3, 0.65}, {1.6, 0.55}, {2.5, 0.9}})},
      {2, drive({{1.7, 0.2}})}};
  const auto excess = zone_excess(kZones, drives, kFacts);
  ASSERT_TRUE(excess);
  EXPECT_DOUBLE_EQ(excess->share, 2.0 / 4.0);
  EXPECT_DOUBLE_EQ(excess->clear_share, 1.0 / 4.0);
  EXPECT_DOUBLE_EQ(excess->max_mps, 0.55 - 0.4);
}

TEST(ZoneExcess, WhoIsBelowOrDrivesBackwardsSlowlyHasNone) {
  const auto excess = zone_excess(kZones, {{1, drive({{1.2, 0.1}, {1.2, -0.1}})}}, kFacts);
  ASSERT_TRUE(excess);
  EXPECT_EQ(excess->share, 0.0);
  EXPECT_EQ(excess->max_mps, 0.0);
  EXPECT_EQ(zone_excess(kZones, {{1, drive({{1.2, -0.7}})}}, kFacts)->share, 1.0);
}

TEST(ZoneExcess, LooksFromTheFirstStepToTheEndOfTheLast) {
  result::Drive late = drive(std::vector<std::pair<double, double>>(11, {1.2, 0.5}));
  late.push_back({.t = 21 * kTick, .pose = {1.2, 0.0, 0.0}, .speed_mps = 2.0});
  late.insert(late.begin(), {.t = 9 * kTick, .pose = {1.2, 0.0, 0.0}, .speed_mps = 2.0});
  EXPECT_EQ(zone_excess(kZones, {{1, late}}, kFacts)->share, 0.0);
}

TEST(ZoneExcess, IsNotKnownWhereNobodyCameIntoAZone) {
  const result::Drives outside{{1, drive({{0.5, 2.0}})}};
  EXPECT_FALSE(zone_excess(kZones, outside, kFacts));
  EXPECT_FALSE(zone_excess({}, {{1, drive({{1.2, 2.0}})}}, kFacts));
}

}  // namespace
}  // namespace hlc::campaign::zone_excess_test
