#pragma once

#include "planner/scenario/scenario.hpp"
#include "planner/scenario/scenario_inputs.hpp"
#include "planner/scenario/scenario_values.hpp"

namespace hlc::scenario {

/// Assembles a scenario and checks that it can be driven (see read_scenario).
/// @throws std::invalid_argument with one line: place in the file or flag, value, bound
[[nodiscard]] Scenario assemble_scenario(const ScenarioValues& values, ScenarioInputs inputs,
                                         const ScenarioChoices& choices);

}  // namespace hlc::scenario
