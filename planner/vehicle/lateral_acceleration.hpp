#pragma once

#include "planner/vehicle/single_track.hpp"

namespace hlc::vehicle {

/// a_lat [m/s^2] and its derivatives.
struct LateralAcceleration {
  double value_mps2{};
  double by_speed{};     ///< da_lat/dv
  double by_steering{};  ///< da_lat/ddelta
};

/// a_lat = v psi' = v^2 kappa(delta), positive to the left.
///
/// In a trim this is the acceleration across the path. While the steering moves, the course turns
/// by beta' u_delta more than the heading; this share is left out, as is usual for this model,
/// because it would jump with the input.
[[nodiscard]] LateralAcceleration lateral_acceleration(const StateVector& x,
                                                       const VehicleParameters& vehicle);

/// True if the friction circle of the limits, if there is one, permits that state with that input
/// (1e-6 relative).
[[nodiscard]] bool is_within_friction(const State& state, const Input& input,
                                      const VehicleParameters& vehicle,
                                      const VehicleLimits& limits);

}  // namespace hlc::vehicle
