#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "planner/policy/policy_settings.hpp"
#include "planner/road/reference_path.hpp"

namespace hlc::policy {

/// The limits of all zones, each once, from the lowest.
[[nodiscard]] std::vector<double> limits_mps(std::span<const SpeedZone> zones);

/// The least limit of the zones that contain the position; none if none does.
[[nodiscard]] std::optional<double> limit_at(std::span<const SpeedZone> zones,
                                             const Point& position_m);

/// Index of the zone with the least limit among those that the path passes between s and s +
/// ahead_m, of equal ones the first that it passes; none if it passes none. The path is checked
/// every centimetre.
/// @pre ahead_m >= 0
[[nodiscard]] std::optional<std::size_t> least_zone_on(std::span<const SpeedZone> zones,
                                                       const road::ReferencePath& path, double s_m,
                                                       double ahead_m);

/// The least limit of the zones that the path passes between s and s + ahead_m; none if it passes
/// none: that of least_zone_on.
[[nodiscard]] std::optional<double> limit_on(std::span<const SpeedZone> zones,
                                             const road::ReferencePath& path, double s_m,
                                             double ahead_m);

}  // namespace hlc::policy
