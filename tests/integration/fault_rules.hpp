#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/result/encounters.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/integration/driven_plan.hpp"

/// What the system promises of every car that a fault affects, as tests ask for it.
namespace hlc::test {

/// From then on an affected car drives only its last agreed plan.
inline constexpr Nanoseconds kReactionTime = 500'000'000;
/// And until then it stands: after the plan of at most 1.6 s, agreed until kReactionTime.
inline constexpr Nanoseconds kStandingTime = 2'500'000'000;
/// Of exact cars, which keep to their plans within 1 mm without noise.
inline constexpr double kTrackingTolerance_m = 0.010;

/// By how much undisturbed cars of the scenario may be off their plans.
inline double tracking_tolerance_m(const scenario::Scenario& scenario) {
  return std::max(kTrackingTolerance_m, scenario.lab ? scenario.lab->tracking_error_max_m : 0.0);
}

inline void expect_only_the_last_plan(const result::Drive& drive, const Commands& commands,
                                      std::uint8_t vehicle, Nanoseconds fault, Nanoseconds to,
                                      double tolerance_m = kTrackingTolerance_m) {
  const auto farthest_m = farthest_from_plan_m(drive, commands, vehicle, fault + kReactionTime, to);
  ASSERT_TRUE(farthest_m) << "vehicle " << int{vehicle} << " follows no plan";
  EXPECT_LE(*farthest_m, tolerance_m) << "vehicle " << int{vehicle};
}

/// And stays there to the end of its record.
inline void expect_stands_in_time(const result::Drive& drive, std::uint8_t vehicle,
                                  Nanoseconds fault) {
  ASSERT_FALSE(drive.empty()) << "vehicle " << int{vehicle};
  ASSERT_GT(drive.back().t, fault + kStandingTime) << "vehicle " << int{vehicle};
  const auto since = standing_since(drive, drive.back().t);
  ASSERT_TRUE(since) << "vehicle " << int{vehicle} << " drives at the end";
  EXPECT_LE(*since, fault + kStandingTime) << "vehicle " << int{vehicle};
}

/// No driven footprints touch, of cars that have all been seen.
/// @param run  with scenario() and drives()
template <class Run>
void expect_nobody_was_touched(const Run& run) {
  const auto vehicles = result::describe(run.scenario(), std::nullopt).vehicles;
  const result::Drives drives = run.drives();
  for (const result::VehicleDescription& vehicle : vehicles) {
    const auto drive = drives.find(vehicle.id.value);
    ASSERT_TRUE(drive != drives.end() && !drive->second.empty())
        << "vehicle " << int{vehicle.id.value} << " has no record";
  }
  const result::Encounters close = result::encounters(vehicles, drives, 0, kForever);
  ASSERT_TRUE(close.min_distance_m) << "no two vehicles were seen at one time";
  EXPECT_EQ(close.collisions, 0U);
}

}  // namespace hlc::test
