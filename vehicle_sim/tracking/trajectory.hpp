#pragma once

#include <optional>
#include <span>

#include "hlc_bridge/core/messages.hpp"

/// How the lab's vehicle reads the timed points of a trajectory command (wire contract, 6.3).
namespace hlc {

/// One instant of a trajectory, in the map's frame.
struct ReferenceSample {
  Point position_m;
  Point velocity_mps;
  Point acceleration_mps2;

  /// (vx ay - vy ax) / |v|^3 [1/m], positive to the left; 0 at standstill, where it is undefined.
  [[nodiscard]] double curvature_per_m() const;
};

/// True if the times increase strictly and every number is finite.
[[nodiscard]] bool is_well_formed(std::span<const TrajectoryPoint> points);

/// The trajectory at time `t`: cubic Hermite interpolation between the first point (but the very
/// first) whose time is not before `t` and its predecessor. With u = (t - t0) / T, T = t1 - t0:
///
///     p(u) = (2u^3 - 3u^2 + 1) p0 + (u^3 - 2u^2 + u) T v0 + (3u^2 - 2u^3) p1 + (u^3 - u^2) T v1
///
/// velocity and acceleration are its derivatives in time (the acceleration jumps at the points).
///
/// @return nothing outside [first, last]: there is no extrapolation
/// @pre `is_well_formed(points)`
[[nodiscard]] std::optional<ReferenceSample> sample(std::span<const TrajectoryPoint> points,
                                                    Nanoseconds t);

/// The lab's lead rule: the first and the last time at which its controller looks at the reference.
inline constexpr Nanoseconds kFirstLook = 110'000'000;
inline constexpr Nanoseconds kLookInterval = 50'000'000;
inline constexpr Nanoseconds kLastLook = 360'000'000;

/// True if the lab's vehicle would follow these points at `t_now`: at least 2, well formed, the
/// first before t_now + 110 ms, the last not before t_now + 360 ms, and at each of the six looks in
/// between |ax|, |ay| <= 20 m/s^2 and, above 0.1 m/s, |curvature| <= 50 1/m.
[[nodiscard]] bool is_followable(std::span<const TrajectoryPoint> points, Nanoseconds t_now);

}  // namespace hlc
