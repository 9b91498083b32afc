#pragma once

#include "planner/vehicle/single_track.hpp"

namespace hlc::vehicle {

/// Rate at which the course turns, and its derivatives:
///
///     d/dt (psi + beta) = v kappa(delta) + beta'(delta) u_delta      [rad/s]
///
/// The second share is the slip that the model gains while its steering moves. Divided by v the sum
/// is the curvature of the driven path; that of a trim is kappa(delta).
struct CourseRate {
  double value_radps{};
  double by_speed{};          ///< kappa [1/m]
  double by_steering{};       ///< v kappa' + beta'' u_delta
  double by_steering_rate{};  ///< beta'
};

[[nodiscard]] CourseRate course_rate(const StateVector& x, const Input& u,
                                     const VehicleParameters& vehicle);

/// At standstill a path has no curvature, and a car may move its wheels. So the limit is one on the
/// course rate, |d/dt (psi + beta)| <= curvature_max sqrt(v^2 + creep^2): from 0.1 m/s on it equals
/// that on the curvature to 5 %, and to 1 % from 0.21 m/s on.
inline constexpr double kCreepSpeed_mps = 0.03;

/// sqrt(v^2 + creep^2) and its derivative by v.
struct TurningSpeed {
  double value_mps{};
  double by_speed{};
};
[[nodiscard]] TurningSpeed turning_speed(double speed_mps);

/// True if the limit on the curvature, if there is one, permits that state with that input (1e-6
/// relative).
[[nodiscard]] bool is_within_curvature(const State& state, const Input& input,
                                       const VehicleParameters& vehicle,
                                       const VehicleLimits& limits);

}  // namespace hlc::vehicle
