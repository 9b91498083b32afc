#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::result {

/// How close the driven footprints came to each other.
struct Encounters {
  std::optional<double> min_distance_m;  ///< none if no two vehicles were ever recorded together
  std::size_t collisions{};              ///< how often a pair began to touch
};

/// Checks every instant in [from, to] at which a vehicle was recorded, for every pair of vehicles
/// that both have a pose then (driven_pose_at: none after the end of its record, where the vehicle
/// may be anywhere). Footprints are rectangles along the yaw, without margin.
/// @param vehicles  their footprints; vehicles without a drive are skipped
[[nodiscard]] Encounters encounters(std::span<const VehicleDescription> vehicles,
                                    const Drives& drives, Nanoseconds from, Nanoseconds to);

/// The same of every vehicle with every obstacle, from the time on at which that one is there.
/// @param step0   time of step 0 of the run
/// @param period  of a step
[[nodiscard]] Encounters encounters_with(std::span<const Obstacle> obstacles,
                                         std::span<const VehicleDescription> vehicles,
                                         const Drives& drives, Nanoseconds step0,
                                         Nanoseconds period, Nanoseconds to);

/// The distance of two driven footprints at one time.
struct TimedDistance {
  Nanoseconds t{};
  double distance_m{};  ///< 0: they touch
};

/// The same for one pair at every such instant, as a series over time.
[[nodiscard]] std::vector<TimedDistance> footprint_distances(const VehicleDescription& a,
                                                             const Drive& drive_a,
                                                             const VehicleDescription& b,
                                                             const Drive& drive_b, Nanoseconds from,
                                                             Nanoseconds to);

}  // namespace hlc::result
