#pragma once

#include <filesystem>

#include "planner/vehicle/identified_vehicle.hpp"

namespace hlc::scenario {

/// How the vehicles of a scenario move, for who simulates them: `vehicle` and `limits` of the
/// automaton's file. All else in both files is skipped.
/// @param scenario_file  YAML
/// @throws std::invalid_argument with one line: file, line, key, value and what is allowed
[[nodiscard]] vehicle::IdentifiedVehicle vehicle_model_of_file(
    const std::filesystem::path& scenario_file);

}  // namespace hlc::scenario
