#include "hlc_bridge/result/guest_encounters.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hlc::result::guest_encounters_test {
namespace {

constexpr Nanoseconds kTick = 20'000'000;
constexpr Footprint kSquare{0.2, 0.2};

const std::vector<VehicleDescription> kVehicles{{{1}, "car", std::nullopt, kSquare}};
const std::vector<VehicleDescription> kGuests{{{9}, "guest", std::nullopt, kSquare}};

/// At the origin, with these speeds, one each tick.
Drive standing(const std::vector<double>& speeds_mps) {
  Drive drive;
  for (std::size_t i = 0; i < speeds_mps.size(); ++i) {
    drive.push_back({.t = i * kTick, .pose = {}, .speed_mps = speeds_mps[i]});
  }
  return drive;
}

/// At these places on the x axis.
Drive at(const std::vector<double>& places_m) {
  Drive drive;
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    drive.push_back({.t = i * kTick, .pose = {places_m[i], 0.0, 0.0}});
  }
  return drive;
}

GuestEncounters of(const Drive& vehicle, const Drive& guest) {
  return guest_encounters(kVehicles, kGuests, {{1, vehicle}, {9, guest}}, 0, 1'000 * kTick);
}

TEST(GuestEncounters, ATouchOfAMovingVehicleIsACollision) {
  const GuestEncounters found = of(standing({0.5, 0.5, 0.5}), at({0.5, 0.1, 0.5}));
  EXPECT_EQ(found.collisions, 1U);
  EXPECT_EQ(found.touched, 0U);
  EXPECT_EQ(found.min_distance_m, 0.0);
}

TEST(GuestEncounters, ATouchOfAStandingVehicleIsTheGuests) {
  const GuestEncounters found =
      of(standing({0.5, 0.0, 0.01, 0.0, 0.0}), at({0.5, 0.1, 0.1, 0.5, 0.1}));
  EXPECT_EQ(found.collisions, 0U);
  EXPECT_EQ(found.touched, 2U);
}

TEST(GuestEncounters, AVehicleThatMovesOffWhileItIsTouchedCollides) {
  const GuestEncounters found = of(standing({0.0, 0.0, 0.3, 0.3}), at({0.5, 0.1, 0.1, 0.1}));
  EXPECT_EQ(found.collisions, 1U);
  EXPECT_EQ(found.touched, 0U);
}

TEST(GuestEncounters, TheLeastDistanceIsThatOfTheFootprints) {
  const GuestEncounters found = of(standing({0.5, 0.5}), at({0.5, 0.4}));
  EXPECT_NEAR(found.min_distance_m.value(), 0.2, 1e-12);
  EXPECT_FALSE(guest_encounters(kVehicles, {}, {}, 0, kTick).min_distance_m);
}

}  // namespace
}  // namespace hlc::result::guest_encounters_test
