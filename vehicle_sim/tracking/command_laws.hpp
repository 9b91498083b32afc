#pragma once

#include <optional>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/vehicle/identified_motion.hpp"

/// The vehicle's response to commands other than trajectories (wire contract, 6.4), with the lab's
/// figures where it states them.
namespace hlc::tracking {

/// Throttle and steering as commanded, clamped to [-1, 1].
[[nodiscard]] vehicle::ActuatorInput direct_input(const DirectCommand& command);

/// Servo per curvature, 0.241857 m: the lab's figure for the wanted curvature kappa [1/m],
///
///     steering = 0.241857 kappa, clamped to [-1, 1]
[[nodiscard]] double steering_for_curvature(double curvature_per_m);

/// Keeps a wanted speed v by throttle: feed forward and PI,
///
///     throttle = sign(v) (0.152744 |v|)^0.62791 + 0.3 e + i,   e = v - measured speed
///     i grows by 0.01 e per tick of 20 ms and stays within +- 0.5
///
/// clamped to [-1, 1]. Has the state i: one object per vehicle, `reset` when another law takes
/// over.
class SpeedControl {
 public:
  [[nodiscard]] double tick(double wanted_mps, double measured_mps);
  void reset() { integral_ = 0.0; }

 private:
  double integral_{};
};

/// Stanley's law on the front axle, at h = 0.075 m before the pose: with the nearest point of the
/// path (polyline, closed if its ends are the same point), its heading psi_p and the signed
/// distance e of the axle to it (positive: the path lies to the left),
///
///     delta = psi_p - yaw + atan(k e / (|v| + 0.1 m/s)),   k = 2 /s
///
/// is the angle of the front wheel; a single-track model of wheelbase L = 0.15 m turns with
/// curvature tan(delta) / L, which `steering_for_curvature` makes the servo's.
/// @return nothing if there is nothing to follow: fewer than two points, only one place, or an open
/// path whose end has been reached
[[nodiscard]] std::optional<double> steering_for_path(const PathTrackingCommand& command,
                                                      const vehicle::VehicleMotion& estimate);

}  // namespace hlc::tracking
