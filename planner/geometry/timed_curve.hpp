#pragma once

#include <Eigen/Core>

#include "planner/geometry/pose.hpp"

/// Timed points of a motion and the curve between two of them, as interpreted by the lab's vehicle
/// (wire contract, 6.3).
namespace hlc {

/// One timed point of a motion, for a vehicle that follows points.
struct TimedPoint {
  double time_s{};
  Point position_m{Point::Zero()};
  Eigen::Vector2d velocity_mps{Point::Zero()};
};

/// One instant of a curve, in the frame of its points.
struct CurveSample {
  Point position_m;
  Point velocity_mps;
  Point acceleration_mps2;

  /// (vx ay - vy ax) / |v|^3 [1/m], positive to the left; 0 at standstill, where it is undefined.
  [[nodiscard]] double curvature_per_m() const;
};

/// Cubic Hermite interpolation between two points T = `duration_s` apart, at u = `share` of it:
///
///     p(u) = (2u^3 - 3u^2 + 1) p0 + (u^3 - 2u^2 + u) T v0 + (3u^2 - 2u^3) p1 + (u^3 - u^2) T v1
///
/// velocity and acceleration are its derivatives in time (the acceleration is linear in u, and
/// jumps at the points). Times of the points are ignored. @pre duration_s > 0
[[nodiscard]] CurveSample interpolated(const TimedPoint& from, const TimedPoint& to,
                                       double duration_s, double share);

}  // namespace hlc
