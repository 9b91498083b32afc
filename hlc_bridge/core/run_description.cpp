#include "hlc_bridge/core/run_description.hpp"

#include "planner/search/search_options.hpp"

namespace hlc {

RunDescription describe(const Scenario& scenario, std::optional<std::uint64_t> noise_seed) {
  const UniversalAutomaton& automaton = scenario.subgraph->automaton();
  RunDescription description;
  description.scenario = scenario.name;
  description.profile = scenario.profile.name;
  description.engine = to_string(scenario.search.engine);
  description.map = scenario.map_file ? scenario.map_file->filename().string() : "";
  description.noise_seed = noise_seed;
  description.subgraph = scenario.subgraph->spec().name;
  description.horizon_steps = scenario.horizon_steps;
  description.step_s = automaton.step_s;
  description.automaton = scenario.subgraph;
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    description.vehicles.push_back(
        {vehicle.id, vehicle.name, vehicle.path, automaton.vehicle.footprint});
  }
  return description;
}

}  // namespace hlc
