#include "planner/scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner/common/node.hpp"
#include "planner/scenario/priority_values.hpp"
#include "planner/scenario/reference_speeds.hpp"
#include "planner/scenario/scenario_assembly.hpp"
#include "planner/scenario/scenario_inputs.hpp"
#include "planner/scenario/scenario_values.hpp"

namespace hlc::scenario {
namespace {

controller::DeviationRules deviation_rules(const Scenario& scenario) {
  controller::DeviationRules rules;
  if (scenario.lab) rules.tracking_error_max_m = scenario.lab->tracking_error_max_m;
  return rules;
}

}  // namespace

Scenario read_scenario(const ScenarioChoices& choices) {
  const ScenarioValues values = parse_scenario(Node::read_yaml(choices.file), choices.file);
  return assemble_scenario(values, load_inputs(values, choices), choices);
}

Scenario read_scenario(const ScenarioChoices& choices,
                       std::shared_ptr<const automaton::UniversalAutomaton> automaton,
                       const std::vector<automaton::SubgraphSpec>& subgraphs) {
  const ScenarioValues values = parse_scenario(Node::read_yaml(choices.file), choices.file);
  return assemble_scenario(values, load_inputs(values, choices, std::move(automaton), subgraphs),
                           choices);
}

std::vector<std::filesystem::path> files_of(const Scenario& scenario) {
  std::vector<std::filesystem::path> files{scenario.file, scenario.automaton_file};
  if (scenario.map_file) files.push_back(*scenario.map_file);
  if (scenario.lab_file) files.push_back(*scenario.lab_file);
  for (const ScenarioGuest& guest : scenario.guests) {
    if (guest.drive == GuestDrive::kTrack) files.push_back(guest.track_file);
  }
  return files;
}

const ScenarioVehicle& vehicle_of(const Scenario& scenario, VehicleId id) {
  const auto found = std::ranges::find(scenario.vehicles, id, &ScenarioVehicle::id);
  if (found != scenario.vehicles.end()) return *found;
  std::vector<unsigned> known;
  for (const ScenarioVehicle& vehicle : scenario.vehicles) known.push_back(vehicle.id.value);
  throw std::invalid_argument(fmt::format("{}: vehicle id = {}, must be one of {}",
                                          scenario.file.string(), id.value,
                                          fmt::join(known, ", ")));
}

controller::PreparedSubgraph prepare_subgraph_of(const Scenario& scenario) {
  return controller::prepare_subgraph(scenario.subgraph, scenario.horizon_steps, scenario.search);
}

namespace {

/// They plan for other vehicles only, so they need no others themselves.
controller::ControllerFactory others_of(const Scenario& scenario,
                                        const controller::PreparedSubgraph& on) {
  Scenario sequential = scenario;
  sequential.rounds = controller::Rounds::kSequential;
  const auto others = std::make_shared<const Scenario>(std::move(sequential));
  return [others, on](VehicleId id) -> std::unique_ptr<controller::Controller> {
    const bool is_named =
        std::ranges::find(others->vehicles, id, &ScenarioVehicle::id) != others->vehicles.end();
    if (!is_named && others->routes.empty()) return nullptr;
    return make_controller(*others, id, on);
  };
}

/// subgraph_at, prepared.
controller::PreparedSubgraph prepared_at(const Scenario& scenario, double reference_speed_mps,
                                         const controller::PreparedSubgraph& on) {
  auto subgraph = subgraph_at(on.subgraph, reference_speed_mps, scenario.horizon_steps);
  if (subgraph == on.subgraph) return on;
  return controller::prepare_subgraph(std::move(subgraph), scenario.horizon_steps, scenario.search);
}

}  // namespace

std::unique_ptr<controller::Controller> make_controller(const Scenario& scenario, VehicleId id) {
  return make_controller(scenario, id, prepare_subgraph_of(scenario));
}

std::unique_ptr<controller::Controller> make_controller(const Scenario& scenario, VehicleId id,
                                                        controller::PreparedSubgraph on) {
  const controller::ControllerStrategies& rules = scenario.profile.strategies;
  const std::string why = unsuitable_priorities(rules.priorities, rules.coordination);
  if (!why.empty()) {
    throw std::invalid_argument(
        fmt::format("priorities = {}, must be {}", rules.priorities.strategy->name, why));
  }
  std::vector<road::DrivableRoute> routes = scenario.routes;
  double reference_speed_mps = scenario.reference_speed_mps;
  const auto named = std::ranges::find(scenario.vehicles, id, &ScenarioVehicle::id);
  if (named != scenario.vehicles.end()) {
    routes = {{.name = named->name,
               .path = named->path,
               .corridor = named->corridor,
               .driving_line = named->driving_line,
               .number = named->route_number,
               .goal = named->goal,
               .speed_sections = named->speed_sections}};
    reference_speed_mps = named->reference_speed_mps.value_or(reference_speed_mps);
  }
  controller::ControllerFactory others;
  if (scenario.rounds == controller::Rounds::kTwo) others = others_of(scenario, on);
  if (named != scenario.vehicles.end() && named->reference_speed_mps) {
    on = prepared_at(scenario, reference_speed_mps, on);
  }
  std::vector<coordination::Guest> guests;
  for (const ScenarioGuest& one : scenario.guests) guests.push_back(one.guest);
  auto controller = std::make_unique<controller::Controller>(
      controller::ControllerOptions{.vehicle = id,
                                    .horizon_steps = scenario.horizon_steps,
                                    .reference_speed_mps = reference_speed_mps,
                                    .contouring_weight = scenario.contouring_weight,
                                    .held_up_contouring_weight = scenario.held_up_contouring_weight,
                                    .reference_rule = scenario.profile.reference_rule,
                                    .strategies = scenario.profile.strategies,
                                    .search = scenario.search,
                                    .deviation = deviation_rules(scenario),
                                    .conflicts = scenario.conflicts,
                                    .lab = scenario.lab,
                                    .guests = std::move(guests),
                                    .others = std::move(others)},
      std::move(on), std::move(routes));
  for (const ScenarioObstacle& one : scenario.obstacles) controller->add_obstacle(one.area_m);
  return controller;
}

Pose measured_start(const Scenario& scenario, const ScenarioVehicle& vehicle) {
  const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
  Pose pose = vehicle.start;
  pose.heading_rad =
      wrap_angle(pose.heading_rad +
                 automaton::yaw_minus_heading_rad(0.0, automaton.vehicle, automaton.identified));
  return pose;
}

}  // namespace hlc::scenario
