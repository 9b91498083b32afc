#include "planner/policy/speed_zones.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/num_seeds.hpp"

namespace hlc::policy::speed_zones_test {
namespace {

SpeedZone zone(double min_x_m, double max_x_m, double max_speed_mps) {
  return {.min_x_m = min_x_m,
          .max_x_m = max_x_m,
          .min_y_m = -1.0,
          .max_y_m = 1.0,
          .max_speed_mps = max_speed_mps};
}

const road::ReferencePath kEast({{0.0, 0.0}, {10.0, 0.0}}, false);

TEST(SpeedZones, HoldAsSoonAsTheWayAheadComesThroughThemAndUntilTheyAreLeft) {
  const std::vector<SpeedZone> zones{zone(2.0, 3.0, 0.4)};
  EXPECT_EQ(limit_on(zones, kEast, 1.4, 0.5), std::nullopt);
  EXPECT_EQ(limit_on(zones, kEast, 1.6, 0.5), 0.4);
  EXPECT_EQ(limit_on(zones, kEast, 2.9, 0.5), 0.4);
  EXPECT_EQ(limit_on(zones, kEast, 3.1, 0.5), std::nullopt);
  EXPECT_EQ(limit_on({}, kEast, 2.5, 0.5), std::nullopt);
}

TEST(SpeedZones, OfSeveralTheLowestLimitCounts) {
  const std::vector<SpeedZone> zones{zone(2.0, 3.0, 0.6), zone(2.5, 2.7, 0.4), zone(2.0, 3.0, 0.5)};
  EXPECT_EQ(limit_on(zones, kEast, 2.1, 0.1), 0.5);
  EXPECT_EQ(limit_on(zones, kEast, 2.1, 0.45), 0.4);
  EXPECT_EQ(limits_mps(zones), (std::vector<double>{0.4, 0.5, 0.6}));
}

TEST(SpeedZones, HoldWhereAPositionIs) {
  const std::vector<SpeedZone> zones{zone(2.0, 3.0, 0.6), zone(2.5, 2.7, 0.4), zone(2.0, 3.0, 0.5)};
  EXPECT_EQ(limit_at(zones, {2.1, 0.9}), 0.5);
  EXPECT_EQ(limit_at(zones, {2.6, -0.9}), 0.4);
  EXPECT_EQ(limit_at(zones, {2.6, 1.1}), std::nullopt);
  EXPECT_EQ(limit_at({}, {2.6, 0.0}), std::nullopt);
}

TEST(SpeedZones, AClosedPathIsLookedAtBeyondItsEnd) {
  const road::ReferencePath round({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}}, true);
  EXPECT_EQ(limit_on(std::vector{zone(0.1, 0.4, 0.4)}, round, 15.8, 0.5), 0.4);
}

// The values of limit_on at every centimetre hold for every place in between, to a centimetre.
TEST(SpeedZones, NoPlaceInAZoneIsComeToWithoutItsLimit) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(200); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> along(0.0, 9.0);
    const double from_m = along(random);
    const std::vector<SpeedZone> zones{zone(from_m, from_m + 0.3, 0.4)};
    const double s_m = along(random);
    const bool is_ahead = s_m + 0.5 > from_m + 0.01 && s_m < from_m + 0.29;
    const bool is_away = s_m + 0.5 < from_m || s_m > from_m + 0.3;
    if (!is_ahead && !is_away) continue;
    EXPECT_EQ(limit_on(zones, kEast, s_m, 0.5).has_value(), is_ahead);
  }
}

}  // namespace
}  // namespace hlc::policy::speed_zones_test
