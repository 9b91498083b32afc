#include "vehicle_sim/guest/guest_driver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "planner/coordination/guest.hpp"
#include "tests/support/num_seeds.hpp"
#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

namespace hlc::guest::guest_driver_test {
namespace {

using simulated_vehicle::SimulatedVehicle;

constexpr Footprint kMuCar{0.22, 0.107};
constexpr coordination::GuestLimits kLimits{
    .speed_mps = 1.0, .acceleration_mps2 = 1.5, .deceleration_mps2 = 3.0, .curvature_per_m = 4.0};
constexpr std::size_t kTicksOfStep = 10;
constexpr std::size_t kHorizonSteps = 8;

std::vector<SimulatedVehicle::Tick> driven(const GuestDriverOptions& driver, const Pose& start,
                                           std::size_t ticks,
                                           std::optional<std::uint64_t> noise_seed) {
  SimulatedVehicle vehicle({.vehicle_id = driver.vehicle.value,
                            .start = start,
                            .noise_seed = noise_seed,
                            .driver = driver});
  std::vector<SimulatedVehicle::Tick> result;
  for (std::size_t i = 0; i < ticks; ++i) result.push_back(vehicle.tick(i * kVehiclePeriod));
  return result;
}

/// Whether the vehicle stays in what can be reached from its published state, for the horizon from
/// the step after `tick` on.
void expect_in_reach(const std::vector<SimulatedVehicle::Tick>& ticks, std::size_t tick,
                     const coordination::Guest& guest) {
  const coordination::MeasuredVehicle measured{.vehicle = guest.vehicle,
                                               .pose = ticks[tick].state.pose,
                                               .speed_mps = ticks[tick].state.speed_mps};
  constexpr double kStep_s = 1e-9 * kTicksOfStep * kVehiclePeriod;
  for (std::size_t j = 1; j <= kHorizonSteps; ++j) {
    const double from_s = static_cast<double>(j) * kStep_s;
    const ConvexPolygon area =
        coordination::reachable_area(guest, measured, from_s, from_s + kStep_s);
    for (std::size_t i = 0; i <= kTicksOfStep; ++i) {
      const result::DrivenSample& later = ticks[tick + j * kTicksOfStep + i].driven;
      ASSERT_TRUE(contains(area, footprint_area(kMuCar, later.pose), 0.0))
          << "state of tick " << tick << ", step " << j << ", tick " << i;
    }
  }
}

TEST(GuestDriver, AnIdentifiedCarThatItDrivesStaysInReach) {
  constexpr std::size_t kTicks = 1500;
  const coordination::Guest guest{
      .vehicle = {9}, .footprint = kMuCar, .safety_margin_m = 0.0, .limits = kLimits};
  for (std::uint64_t seed = 1; seed <= test::num_seeds(20); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto noise_seed = seed % 2 == 0 ? std::optional(seed) : std::nullopt;
    const auto ticks = driven({.vehicle = {9},
                               .limits = kLimits,
                               .seed = seed,
                               .home_m = {.min_m = {0.3, 0.3}, .max_m = {4.2, 3.7}}},
                              {1.0, 1.0, 0.3}, kTicks, noise_seed);
    double fastest_mps = 0.0;
    for (const SimulatedVehicle::Tick& tick : ticks) {
      fastest_mps = std::max(fastest_mps, tick.driven.speed_mps);
    }
    EXPECT_GT(fastest_mps, 0.5 * kLimits.speed_mps);
    for (const SimulatedVehicle::Tick& tick : ticks) {
      const Point off_m = tick.driven.pose.position_m() - Point(2.25, 2.0);
      ASSERT_LT(off_m.norm(), 4.0) << "it went for good";
    }
    const std::size_t last = kTicks - (kHorizonSteps + 1) * kTicksOfStep - 1;
    for (std::size_t tick = 0; tick < last; tick += kTicksOfStep) {
      expect_in_reach(ticks, tick, guest);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(GuestDriver, FollowsATrackByItsTimesAndStandsAtItsEnd) {
  constexpr double kRadius_m = 0.8;
  constexpr double kSpeed_mps = 0.5;
  constexpr double kDuration_s = 12.0;
  std::vector<TimedPoint> track;
  for (int i = 0; i <= 120; ++i) {
    const double t_s = kDuration_s * i / 120.0;
    const double angle_rad = kSpeed_mps * t_s / kRadius_m;
    track.push_back({.time_s = t_s,
                     .position_m = {2.0 + kRadius_m * std::sin(angle_rad),
                                    2.0 - kRadius_m * std::cos(angle_rad)},
                     .velocity_mps = Point::Zero()});
  }
  const auto ticks = driven({.vehicle = {9}, .limits = kLimits, .track = track}, {2.0, 1.2, 0.0},
                            750, std::nullopt);
  for (std::size_t i = 100; i < 600; i += 50) {  // 2 s ... 12 s
    const Point at_m = ticks[i].driven.pose.position_m();
    const Point wanted_m = track[i / 5].position_m;
    EXPECT_LT((at_m - wanted_m).norm(), 0.25) << "at " << 0.02 * static_cast<double>(i) << " s";
    EXPECT_NEAR((at_m - Point(2.0, 2.0)).norm(), kRadius_m, 0.1);
  }
  EXPECT_LT(std::abs(ticks.back().driven.speed_mps), 0.02);
  EXPECT_LT((ticks.back().driven.pose.position_m() - track.back().position_m).norm(), 0.25);
}

}  // namespace
}  // namespace hlc::guest::guest_driver_test
