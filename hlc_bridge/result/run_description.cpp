#include "hlc_bridge/result/run_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/common/yaml_text.hpp"
#include "planner/scenario/engine_choice.hpp"

namespace hlc::result {

RunDescription describe(const scenario::Scenario& scenario,
                        std::optional<std::uint64_t> noise_seed) {
  const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
  RunDescription description;
  description.scenario = scenario.name;
  description.profile = scenario.profile.name;
  description.priorities = scenario.profile.strategies.priorities.strategy->name;
  description.engine = scenario::engine_name(scenario.search);
  description.map = scenario.map_file ? scenario.map_file->filename().string() : "";
  description.noise_seed = noise_seed;
  description.subgraph = scenario.subgraph->spec().name;
  description.policy = scenario.policy;
  description.has_two_rounds = scenario.rounds == controller::Rounds::kTwo;
  description.horizon_steps = scenario.horizon_steps;
  description.step_s = automaton.step_s;
  if (scenario.lab) description.tracking_error_max_m = scenario.lab->tracking_error_max_m;
  description.automaton = scenario.subgraph;
  description.conflicts = scenario.conflicts;
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    description.vehicles.push_back(
        {vehicle.id, vehicle.name, vehicle.path, automaton.vehicle.footprint});
  }
  for (const scenario::ScenarioObstacle& one : scenario.obstacles) {
    description.obstacles.push_back({.name = one.name, .area_m = one.area_m});
  }
  for (const scenario::ScenarioGuest& one : scenario.guests) {
    description.guests.push_back({one.guest.vehicle, one.name, std::nullopt, one.guest.footprint});
  }
  return description;
}

void check_run(const RunFacts& facts, const RunDescription& description) {
  const double period_s = 1e-9 * static_cast<double>(facts.period);
  if (std::abs(period_s - description.step_s) > 1e-9) {
    throw std::runtime_error(
        fmt::format("run.json: period_ns = {}, must be the step of scenario {}, {} s", facts.period,
                    description.scenario, shortest_text(description.step_s)));
  }
  for (const std::uint8_t id : facts.vehicle_ids) {
    if (std::none_of(description.vehicles.begin(), description.vehicles.end(),
                     [id](const auto& vehicle) { return vehicle.id.value == id; })) {
      throw std::runtime_error(fmt::format(
          "run.json: vehicle_ids has {}, which is not in scenario {}", id, description.scenario));
    }
  }
}

}  // namespace hlc::result
