#pragma once

#include "planner/apps/cli.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::apps {

/// The flags that choose a scenario.
void declare_scenario_flags(CLI::App& app, scenario::ScenarioChoices& choices);

}  // namespace hlc::apps
