#pragma once

#include "planner/coordination/messages.hpp"
#include "planner/coordination/missing.hpp"
#include "planner/geometry/footprint.hpp"

namespace hlc::coordination {

/// What a guest can do, as stated in the scenario. All are > 0.
struct GuestLimits {
  double speed_mps{};
  double acceleration_mps2{};
  double deceleration_mps2{};
  double curvature_per_m{};  ///< of its path, to either side
};

/// A vehicle that takes no part in the coordination: a human, a script or other software drives it
/// where it likes, forwards, within its limits. The others know of it what the state list shows.
struct Guest {
  VehicleId vehicle;
  Footprint footprint;
  double safety_margin_m{};
  GuestLimits limits;
};

/// How far a measured state may be from the true one: the camera's noise, and the side slip of a
/// µCar, whose course is not its yaw.
struct GuestErrors {
  double position_m{0.01};
  double course_rad{0.2};
  double speed_mps{0.05};
};

/// A convex polygon around everything that a guest measured at `measured` can occupy from t(k) +
/// from_s to t(k) + to_s.
///
/// Within time t it drives at least s_low = v t - d t^2 / 2 (until it stands) and at most s_high,
/// with acceleration a up to its highest speed; a faster one keeps its speed. A path of length s
/// with curvature at most K leads in the direction phi from its course at most
///
///     h(phi, s) = (sin phi + K s - phi) / K         if K s >= phi   (turn there, then straight)
///                 (sin phi - sin(phi - K s)) / K    otherwise       (turn all the way)
///
/// which over s in [s_low, s_high] is largest at one of the ends. The polygon has sixteen sides,
/// each as far out as h, the errors and the footprint at any heading within K s_high require; it is
/// the smallest one with these directions but for the footprint's part.
///
/// Passive safety: a vehicle that moves only where it meets none of these areas, and whose plan
/// ends in standstill, is never moving when the two touch, as long as the guest keeps its limits.
/// Induction over the steps: what a guest can reach from a later state, it can reach from the
/// earlier one, so the rest of a plan stays safe, whatever the guest does.
/// @pre 0 <= from_s <= to_s
[[nodiscard]] ConvexPolygon reachable_area(const Guest& guest, const MeasuredVehicle& measured,
                                           double from_s, double to_s,
                                           const GuestErrors& errors = {});

}  // namespace hlc::coordination
