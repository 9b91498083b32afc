#pragma once

#include <optional>
#include <span>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/geometry/timed_curve.hpp"

/// Interpretation of the timed points of a trajectory command as in the lab's vehicle (wire
/// contract, 6.3).
namespace hlc::tracking {

/// True if the times increase strictly and every number is finite.
[[nodiscard]] bool is_well_formed(std::span<const TrajectoryPoint> points);

/// The trajectory at time `t`: the curve (planner/geometry/timed_curve.hpp) between the first point
/// (except the very first) whose time is not before `t` and its predecessor.
///
/// @return nothing outside [first, last]: there is no extrapolation
/// @pre `is_well_formed(points)`
[[nodiscard]] std::optional<CurveSample> sample(std::span<const TrajectoryPoint> points,
                                                Nanoseconds t);

/// The lab's lead rule: the first and the last time at which its controller evaluates the
/// reference.
inline constexpr Nanoseconds kFirstLook = 110'000'000;
inline constexpr Nanoseconds kLookInterval = 50'000'000;
inline constexpr Nanoseconds kLastLook = kLookAhead;

/// True if the lab's vehicle would follow these points at `t_now`: at least 2, well formed, the
/// first before t_now + 110 ms, the last not before t_now + 360 ms, and at each of the six
/// evaluations in between |ax|, |ay| <= 20 m/s^2 and, above 0.1 m/s, |curvature| <= 50 1/m.
[[nodiscard]] bool is_followable(std::span<const TrajectoryPoint> points, Nanoseconds t_now);

}  // namespace hlc::tracking
