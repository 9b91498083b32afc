#pragma once

#include <cstdint>
#include <vector>

#include "planner/geometry/pose.hpp"

namespace hlc::apps {

/// Vehicles with an id up to this one have a default start pose.
inline constexpr std::uint8_t kLastDefaultStart = 23;

/// Start pose of a simulated vehicle.
///
/// Without `given` vehicle id stands where the lab's simulated vehicle of that id does: 1 to 15 one
/// behind the other on the outer ring, the others on the lanes of the middle.
/// @param given  empty, or x [m], y [m], yaw [rad] as on the command line
/// @throws std::invalid_argument unless `given` is empty or three finite numbers, and if it is
/// empty for an id above `kLastDefaultStart`
[[nodiscard]] Pose start_pose(std::uint8_t vehicle_id, const std::vector<double>& given);

}  // namespace hlc::apps
