#pragma once

#include <Eigen/Core>

namespace hlc {

/// Bound on every coordinate from outside.
inline constexpr double kLargestCoordinate_m = 1e9;

/// A point or a displacement in the plane [m].
using Point = Eigen::Vector2d;

/// Position and heading in the plane.
///
/// Frame: the map's (x right, y up, origin in a corner of the lab), or the frame that the owner
/// names. Reference point of a vehicle: its centre of gravity, midway between the axles.
/// `heading_rad` is the direction of the vehicle's longitudinal axis, counter-clockwise from x; it
/// is not wrapped.
struct Pose {
  double x_m{};
  double y_m{};
  double heading_rad{};

  [[nodiscard]] Point position_m() const { return {x_m, y_m}; }
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// Pose of a frame B in the world, when `a` is the pose of frame A in the world and `b` that of B
/// in A (the group action Psi_g of the paper, Section 2): first a, then b in a's frame.
[[nodiscard]] Pose compose(const Pose& a, const Pose& b);

/// The pose of `b` seen from `a`: compose(a, between(a, b)) = b.
[[nodiscard]] Pose between(const Pose& a, const Pose& b);

/// A point given in the frame `frame`, in the parent frame of `frame`.
[[nodiscard]] Point transformed(const Point& point_m, const Pose& frame);

/// The same angle in (-pi, pi].
[[nodiscard]] double wrap_angle(double angle_rad);

}  // namespace hlc
