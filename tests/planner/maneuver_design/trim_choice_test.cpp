#include "planner/maneuver_design/trim_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/num_seeds.hpp"

namespace hlc::maneuver_design {
namespace {

const vehicle::VehicleLimits kLimits;

std::vector<DriveSample> around(const std::vector<automaton::Trim>& trims, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  std::vector<DriveSample> drive;
  for (int i = 0; i < 60; ++i) {
    for (const automaton::Trim& trim : trims) {
      drive.push_back({trim.speed_mps + noise(random), trim.steering_rad + noise(random)});
    }
  }
  std::ranges::shuffle(drive, random);
  return drive;
}

TEST(ChooseTrims, FindsTheWaysInWhichAVehicleWasDriven) {
  const std::vector<automaton::Trim> driven{{0.4, -0.6}, {0.8, -0.1}, {0.8, 0.1}, {0.5, 0.5}};
  for (unsigned seed = 0; seed < test::num_seeds(20); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<DriveSample> drive = around(driven, seed);
    drive.insert(drive.end(), 80, {0.01, 0.3});  // stands, the wheels turned
    const std::vector<ChosenTrim> chosen = choose_trims(drive, 5, {}, kLimits);
    ASSERT_EQ(chosen.size(), 5U);
    EXPECT_EQ(chosen[0].trim, automaton::Trim{});
    EXPECT_NEAR(chosen[0].share, 80.0 / 320.0, 1e-12);
    for (std::size_t i = 0; i < driven.size(); ++i) {
      EXPECT_NEAR(chosen[i + 1].trim.speed_mps, driven[i].speed_mps, 0.012);
      EXPECT_NEAR(chosen[i + 1].trim.steering_rad, driven[i].steering_rad, 0.012);
      EXPECT_NEAR(chosen[i + 1].share, 60.0 / 320.0, 1e-12);
    }
  }
}

TEST(ChooseTrims, EachIsTheMeanOfTheSamplesThatAreNearestToIt) {
  for (unsigned seed = 0; seed < test::num_seeds(20); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> speed(0.1, 3.0);
    std::uniform_real_distribution<double> steering(-0.6, 0.6);
    std::vector<DriveSample> drive(500);
    for (DriveSample& sample : drive) sample = {speed(random), steering(random)};
    const std::vector<ChosenTrim> chosen = choose_trims(drive, 12, {}, kLimits);
    std::vector<DriveSample> sums(chosen.size());
    std::vector<int> sizes(chosen.size());
    for (const DriveSample& sample : drive) {
      const auto distance = [&sample](const ChosenTrim& one) {
        return std::hypot((one.trim.speed_mps - sample.speed_mps) / kLimits.speed_max_mps,
                          (one.trim.steering_rad - sample.steering_rad) / kLimits.steering_max_rad);
      };
      const auto nearest =
          std::min_element(chosen.begin() + 1, chosen.end(),
                           [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
      const auto i = static_cast<std::size_t>(nearest - chosen.begin());
      sums[i].speed_mps += sample.speed_mps;
      sums[i].steering_rad += sample.steering_rad;
      ++sizes[i];
    }
    // Trims are rounded to 0.001: a sample between two may belong to the other by that.
    for (std::size_t i = 1; i < chosen.size(); ++i) {
      ASSERT_GT(sizes[i], 0);
      EXPECT_NEAR(chosen[i].trim.speed_mps, sums[i].speed_mps / sizes[i], 0.05);
      EXPECT_NEAR(chosen[i].trim.steering_rad, sums[i].steering_rad / sizes[i], 0.01);
    }
  }
}

TEST(ChooseTrims, TheSameDriveInAnyOrderGivesTheSameTrims) {
  std::vector<DriveSample> drive = around({{0.4, -0.5}, {0.7, 0.2}, {0.6, 0.4}}, 7);
  const std::vector<ChosenTrim> chosen = choose_trims(drive, 4, {}, kLimits);
  std::ranges::reverse(drive);
  const std::vector<ChosenTrim> again = choose_trims(drive, 4, {}, kLimits);
  for (std::size_t i = 0; i < chosen.size(); ++i) EXPECT_EQ(chosen[i].trim, again[i].trim);
}

TEST(ChooseTrims, StaysWithinTheLimits) {
  const std::vector<DriveSample> drive{{5.0, -1.0}, {0.5, 1.0}};
  vehicle::VehicleLimits limits;
  limits.speed_max_mps = 3.7006;
  limits.steering_max_rad = 0.6106;
  const std::vector<ChosenTrim> chosen = choose_trims(drive, 3, {}, limits);
  EXPECT_EQ(chosen[1].trim, (automaton::Trim{3.700, -0.610}));
  EXPECT_EQ(chosen[2].trim, (automaton::Trim{0.5, 0.610}));
  limits.friction_mps2 = 8.0;
  EXPECT_THROW((void)choose_trims(drive, 3, {}, limits), std::invalid_argument);
}

TEST(ChooseTrims, ReversingSamplesAreLeftOut) {
  std::vector<DriveSample> drive{{0.5, 0.1}, {0.8, -0.2}, {0.01, 0.3}, {-0.02, 0.0}};
  const std::vector<ChosenTrim> without = choose_trims(drive, 3, {}, kLimits);
  drive.insert(drive.end(), 20, {-1.0, 0.4});
  const std::vector<ChosenTrim> with = choose_trims(drive, 3, {}, kLimits);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(with[i].trim, without[i].trim);
    EXPECT_EQ(with[i].share, without[i].share);
  }
  EXPECT_EQ(with[0].share, 0.5) << "noise about 0 is standing";
}

TEST(ChooseTrims, ADriveWithTooFewWaysOfMovingIsRefused) {
  EXPECT_THROW((void)choose_trims({{0.0, 0.0}}, 2, {}, kLimits), std::invalid_argument);
  EXPECT_THROW((void)choose_trims({{0.5, 0.1}, {0.5, 0.1}}, 3, {}, kLimits), std::invalid_argument);
  EXPECT_THROW((void)choose_trims({{0.5, 0.1}, {0.5001, 0.1}}, 3, {}, kLimits),
               std::invalid_argument);
}

TEST(DriveSamples, AreTheSpeedAndTheSteeringOfATrim) {
  const vehicle::VehicleParameters vehicle;
  for (const automaton::Trim& trim :
       {automaton::Trim{0.8, 0.0}, automaton::Trim{0.4, 0.6}, automaton::Trim{0.5, -0.48},
        automaton::Trim{}, automaton::Trim{-0.3, 0.2}}) {
    std::vector<DrivePoint> points;
    for (int i = 0; i <= 50; ++i) {
      const double time_s = 0.02 * i;
      points.push_back({time_s, vehicle::trim_motion({1.0, 2.0, 3.0}, trim.speed_mps,
                                                     trim.steering_rad, time_s, vehicle)});
    }
    const std::vector<DriveSample> samples = drive_samples(points, 0.2, vehicle);
    ASSERT_GE(samples.size(), 40U);
    for (const DriveSample& sample : samples) {
      EXPECT_NEAR(sample.speed_mps, trim.speed_mps, 1e-9);
      EXPECT_NEAR(sample.steering_rad, trim.steering_rad, 1e-9);
    }
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
