#pragma once

#include <cstdint>
#include <optional>

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

namespace hlc::closed_loop {

/// The simulated vehicle of a guest, with its driver unless it is driven by hand: then it stands
/// until it receives commands.
/// @param noise_seed  as SimulatedVehicleOptions
[[nodiscard]] simulated_vehicle::SimulatedVehicleOptions guest_vehicle(
    const scenario::ScenarioGuest& guest, std::optional<std::uint64_t> noise_seed,
    simulated_vehicle::Stamps stamps);

}  // namespace hlc::closed_loop
