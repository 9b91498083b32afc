#pragma once

#include <optional>

#include "planner/vehicle/single_track.hpp"

namespace hlc::vehicle {

/// Parameters p1 ... p10 of the lab's identified vehicle model and derived quantities. State: px,
/// py, yaw, speed v; inputs throttle f and steering s in [-1, 1], battery voltage V. With delta = s
/// + p9:
///
///     px'  = p1 v (1 + p2 delta^2) cos(yaw + p3 delta + p10)      (py' the same with sin)
///     yaw' = p4 v delta
///     v'   = p5 v + (p6 + p7 V) sign(f) |f|^p8
///
/// `vehicle_sim/plant` integrates it; the planner needs only the slip, because the lab's vehicle
/// has another heading than the single-track model on the same path.
struct IdentifiedVehicle {
  double path_speed_gain{1.004582};       ///< p1
  double path_speed_steering{-0.142938};  ///< p2 [1/steering^2]
  double slip_gain_rad{0.195236};         ///< p3
  double yaw_rate_gain_per_m{3.560576};   ///< p4
  double drag_per_s{-2.190728};           ///< p5
  double thrust_offset_mps2{-9.726828};   ///< p6
  double thrust_per_volt{2.515565};       ///< p7 [m/s^2/V]
  double throttle_exponent{1.321199};     ///< p8
  double steering_offset{0.032208};       ///< p9
  double slip_offset_rad{-0.012863};      ///< p10
  /// Largest |ds/dt| of the servo; absent: it turns within one tick, as the lab's does in the
  /// model.
  std::optional<double> steering_rate_per_s{};
};

/// A vehicle without identification: the single-track model within its limits, in the form of the
/// identified one. Curvature is proportional to steering and slip proportional to curvature, exact
/// at full steering, |s| = 1 at `steering_max_rad`; in between the slip is off by some milliradians
/// for small angles (14 mrad for 1.07 rad). The throttle is the acceleration, v' = a_max f, without
/// drag. The servo needs as long as the limit of the steering rate asks for from one end to the
/// other: |ds/dt| <= steering_rate_radps / steering_max_rad. Tyres do not slide.
/// @pre 0 < steering_max_rad < pi / 2, other limits above 0
[[nodiscard]] IdentifiedVehicle kinematic_vehicle(const VehicleParameters& vehicle,
                                                  const VehicleLimits& limits);

/// delta (= s + p9) at which the identified vehicle drives a path of this curvature in steady
/// state: the solution of curvature = p4 delta / (p1 (1 + p2 delta^2)) nearest to 0. Not limited to
/// |s| <= 1.
/// @pre p4 > 0, p2 <= 0 (then every curvature has a solution)
[[nodiscard]] double steady_steering(double curvature_per_m, const IdentifiedVehicle& vehicle);

/// s = delta - p9 of `steady_steering`: the input that the servo has on such a path.
[[nodiscard]] double steady_servo(double curvature_per_m, const IdentifiedVehicle& vehicle);

/// p3 delta + p10 [rad]: angle from the vehicle's yaw to its course on a path of this curvature. On
/// a path that is sharper than the vehicle can drive, delta is that of full steering, |s| = 1.
[[nodiscard]] double steady_slip_rad(double curvature_per_m, const IdentifiedVehicle& vehicle);

}  // namespace hlc::vehicle
