#include "hlc_bridge/result/encounters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "planner/geometry/polygon.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::result::encounters_test {
namespace {

constexpr Nanoseconds kTick = 20'000'000;
constexpr Nanoseconds kLongTime = 1'000'000'000'000;

std::vector<VehicleDescription> vehicles(std::size_t count) {
  std::vector<VehicleDescription> vehicles;
  for (std::size_t i = 0; i < count; ++i) {
    vehicles.push_back({VehicleId{static_cast<std::uint8_t>(i + 1)},
                        "",
                        std::nullopt,
                        {.length_m = 0.22, .width_m = 0.107}});
  }
  return vehicles;
}

Drive drive(const std::vector<Pose>& poses) {
  Drive drive;
  for (const Pose& pose : poses) {
    drive.push_back({.t = kTick * drive.size(), .pose = pose});
  }
  return drive;
}

TEST(Encounters, DistanceIsThatOfTheFootprintsAlongTheYaw) {
  const Drives side_by_side{{1, drive({{0, 0, 0}})}, {2, drive({{0, 0.2, 0}})}};
  EXPECT_NEAR(encounters(vehicles(2), side_by_side, 0, kLongTime).min_distance_m.value(),
              0.2 - 0.107, 1e-12);
  const Drives one_across{{1, drive({{0, 0, 0}})}, {2, drive({{0, 0.2, std::numbers::pi / 2.0}})}};
  EXPECT_NEAR(encounters(vehicles(2), one_across, 0, kLongTime).min_distance_m.value(),
              0.2 - 0.107 / 2.0 - 0.11, 1e-12);
}

TEST(Encounters, DistancesOverTimeAreThoseOfEveryInstantWithin) {
  const std::vector<VehicleDescription> two = vehicles(2);
  const Drive standing = drive({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  const Drive leaving = drive({{0.1, 0, 0}, {0.3, 0, 0}, {0.5, 0, 0}, {0.7, 0, 0}});
  const std::vector<TimedDistance> distances =
      footprint_distances(two[0], standing, two[1], leaving, 0, 2 * kTick);
  ASSERT_EQ(distances.size(), 3U);
  EXPECT_EQ(distances[0].distance_m, 0.0);
  EXPECT_NEAR(distances[1].distance_m, 0.3 - 0.22, 1e-12);
  EXPECT_NEAR(distances[2].distance_m, 0.5 - 0.22, 1e-12);
  EXPECT_EQ(distances[2].t, 2 * kTick);
}

TEST(Encounters, CollisionIsCountedWhenAPairBeginsToTouch) {
  const Pose far{1, 0, 0};
  const Pose near{0.1, 0, 0};
  const std::vector<Pose> standing(8, Pose{});
  const Drives drives{{1, drive(standing)},
                      {2, drive({far, near, near, far, far, near, near, far})}};
  const Encounters result = encounters(vehicles(2), drives, 0, kLongTime);
  EXPECT_EQ(result.collisions, 2U);
  EXPECT_EQ(result.min_distance_m, 0.0);
}

TEST(Encounters, TouchingFromTheFirstInstantIsACollision) {
  const Drives drives{{1, drive({{0, 0, 0}})}, {2, drive({{0.1, 0, 0}})}};
  EXPECT_EQ(encounters(vehicles(2), drives, 0, kLongTime).collisions, 1U);
}

TEST(Encounters, OnlyTheAskedTimeCounts) {
  const std::vector<Pose> standing(4, Pose{});
  const Drives drives{{1, drive(standing)},
                      {2, drive({{0.1, 0, 0}, {0.5, 0, 0}, {0.4, 0, 0}, {0.1, 0, 0}})}};
  const Encounters result = encounters(vehicles(2), drives, kTick, 2 * kTick);
  EXPECT_EQ(result.collisions, 0U);
  EXPECT_NEAR(result.min_distance_m.value(), 0.4 - 0.22, 1e-12);
}

TEST(Encounters, AVehicleIsNotComparedBeyondTheEndOfItsRecord) {
  const Drives drives{{1, drive({{0, 0, 0}})}, {2, drive({{1, 0, 0}, {0.5, 0, 0}, {0.1, 0, 0}})}};
  const Encounters result = encounters(vehicles(2), drives, 0, kLongTime);
  EXPECT_EQ(result.collisions, 0U);
  EXPECT_NEAR(result.min_distance_m.value(), 1.0 - 0.22, 1e-12);
}

TEST(Encounters, OneVehicleHasNone) {
  const Drives drives{{1, drive({{0, 0, 0}})}};
  EXPECT_FALSE(encounters(vehicles(1), drives, 0, kLongTime).min_distance_m);
  EXPECT_FALSE(encounters(vehicles(2), drives, 0, kLongTime).min_distance_m);
}

// Property: the short cut by circles changes nothing.
TEST(Encounters, AgreesWithLookingAtEveryPairAndInstant) {
  for (unsigned seed = 0; seed < test::num_seeds(40); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> step_m{-0.15, 0.15};
    const auto cars = vehicles(3);
    Drives drives;
    for (const VehicleDescription& car : cars) {
      Pose pose{0.6 * car.id.value, 0, 0};
      std::vector<Pose> poses;
      for (int i = 0; i < 60; ++i) {
        pose = {pose.x_m + step_m(random), pose.y_m + step_m(random),
                pose.heading_rad + step_m(random)};
        poses.push_back(pose);
      }
      drives[car.id.value] = drive(poses);
    }
    double smallest_m = 1e9;
    std::size_t collisions = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i + 1; j < 3; ++j) {
        bool touched = false;
        for (std::size_t t = 0; t < 60; ++t) {
          const double d_m =
              distance_m(footprint_area(cars[i].footprint, drives.at(cars[i].id.value)[t].pose),
                         footprint_area(cars[j].footprint, drives.at(cars[j].id.value)[t].pose));
          smallest_m = std::min(smallest_m, d_m);
          collisions += d_m == 0.0 && !touched ? 1U : 0U;
          touched = d_m == 0.0;
        }
      }
    }
    const Encounters result = encounters(cars, drives, 0, kLongTime);
    EXPECT_EQ(result.min_distance_m, smallest_m);
    EXPECT_EQ(result.collisions, collisions);
  }
}

TEST(EncountersWithObstacles, AreCountedFromTheStepOnFromWhichTheyStand) {
  const Drives through{{1, drive({{0, 0, 0}, {0.5, 0, 0}, {1.0, 0, 0}, {1.5, 0, 0}, {1.0, 0, 0}})}};
  const auto obstacle = [](std::uint64_t from) {
    return std::vector<Obstacle>{
        {.name = "", .from = from, .area_m = footprint_area({0.1, 0.1}, {1.0, 0.0, 0.0})}};
  };
  const auto found = [&](std::uint64_t from, Nanoseconds to) {
    return encounters_with(obstacle(from), vehicles(1), through, 0, kTick, to);
  };
  EXPECT_EQ(found(0, kLongTime).collisions, 2U) << "it drove on in between";
  EXPECT_EQ(found(0, kLongTime).min_distance_m, 0.0);
  EXPECT_EQ(found(3, kLongTime).collisions, 1U);
  EXPECT_EQ(found(9, kLongTime).collisions, 0U);
  EXPECT_FALSE(found(9, kLongTime).min_distance_m);
  EXPECT_EQ(found(0, kTick).collisions, 0U);
  EXPECT_NEAR(found(0, kTick).min_distance_m.value(), 0.5 - 0.05 - 0.11, 1e-12);
}

}  // namespace
}  // namespace hlc::result::encounters_test
