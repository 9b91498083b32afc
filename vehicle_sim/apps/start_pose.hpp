#pragma once

#include <cstdint>
#include <vector>

#include "planner/geometry/pose.hpp"

namespace hlc::apps {

/// Vehicles with an id up to this one have a default start pose.
inline constexpr std::uint8_t kLastDefaultStart = 23;

/// Start pose of a simulated vehicle.
///
/// Without `given` vehicle id stands on a grid of six columns and four rows, 0.7 m and 1.0 m apart,
/// first at (0.5, 0.5), along x: inside the lab (4.5 m x 4.0 m) and clear of each other.
/// @param given  empty, or x [m], y [m], yaw [rad] as on the command line
/// @throws std::invalid_argument unless `given` is empty or three finite numbers, and if it is
/// empty for an id above `kLastDefaultStart`
[[nodiscard]] Pose start_pose(std::uint8_t vehicle_id, const std::vector<double>& given);

}  // namespace hlc::apps
