#pragma once

#include "planner/scenario/scenario.hpp"
#include "planner/scenario/scenario_inputs.hpp"
#include "planner/scenario/scenario_values.hpp"

namespace hlc::scenario {

/// Fills in the scenario's vehicles and routes: those of the file, drawn ones or those on a circle;
/// with random routes if the file or the command line chooses them. Checks that start poses do not
/// overlap.
/// @pre scenario.subgraph is set
/// @throws std::invalid_argument with one line: place in the file or flag, value, bound
void add_vehicles(const ScenarioValues& values, const ScenarioInputs& inputs,
                  const ScenarioChoices& choices, Scenario& scenario);

}  // namespace hlc::scenario
