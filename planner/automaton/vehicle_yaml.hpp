#pragma once

#include <string>

#include "planner/automaton/automaton.hpp"
#include "planner/common/node.hpp"

namespace hlc::automaton {

/// More is no wheeled vehicle's speed, but given in another unit.
inline constexpr double kMaxVehicleSpeed_mps = 1000.0;

/// Keys wheelbase_m, rear_axle_to_cg_m, length_m, width_m, safety_margin_m (default 0.010), each
/// at most 100 m. Others are not checked.
[[nodiscard]] vehicle::VehicleParameters read_vehicle(const Node& vehicle);

/// Key `identified` of the vehicle: a map with the members of IdentifiedVehicle, all optional, or
/// the word `kinematic` (kinematic_vehicle); absent: the µCar.
[[nodiscard]] vehicle::IdentifiedVehicle read_identified(
    const Node& vehicle, const vehicle::VehicleParameters& parameters,
    const vehicle::VehicleLimits& limits);

/// Keys as the members of VehicleLimits, all required except friction_mps2 and curvature_max_per_m.
/// At most kMaxVehicleSpeed_mps, 1e4 m/s², 1e4 rad/s, 1.5 rad, 1e4 1/m.
[[nodiscard]] vehicle::VehicleLimits read_limits(const Node& limits);

/// Keys speed_mps, steering_rad, within the limits. Others are not checked.
[[nodiscard]] Trim read_trim(const Node& trim, const vehicle::VehicleParameters& vehicle,
                             const vehicle::VehicleLimits& limits);

/// One line of YAML each, which reads back to the same bits; the first with `identified` inside.
[[nodiscard]] std::string to_yaml(const vehicle::VehicleParameters& vehicle,
                                  const vehicle::IdentifiedVehicle& identified);
[[nodiscard]] std::string to_yaml(const vehicle::VehicleLimits& limits);

}  // namespace hlc::automaton
