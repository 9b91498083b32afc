#include "planner/scenario/scenario_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner/automaton/lab_check.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/policy/speed_zones.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/policy_file.hpp"
#include "planner/scenario/priority_values.hpp"
#include "planner/scenario/reference_speeds.hpp"
#include "planner/scenario/scenario_vehicles.hpp"
#include "planner/scenario/search_values.hpp"
#include "planner/scenario/starts.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::scenario {
namespace {

/// The command line's engine, otherwise the file's, otherwise the profile's.
search::SearchOptions choose_search(const ScenarioValues& values, const ScenarioChoices& choices,
                                    const Profile& profile) {
  search::SearchOptions search{.engine = profile.engine, .cost_to_go = profile.cost_to_go};
  search.max_expansions = values.max_expansions;
  search.criterion_weights = values.criterion_weights;
  if (values.engine) choose_engine(*values.engine, search);
  try {
    if (choices.engine) choose_engine(*choices.engine, search);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("--") + error.what());
  }
  try {
    search::check_search_options(search);
  } catch (const std::invalid_argument& error) {
    if (choices.engine) {
      throw std::invalid_argument(fmt::format(
          "--engine = {} with profile {}, must be best_first or ompl_best_first: the profile's "
          "cost-to-go is {}",
          *choices.engine, profile.name, search::to_string(search.cost_to_go)));
    }
    values.node.fail("engine", fmt::format("with profile {}: {}", profile.name, error.what()));
  }
  return search;
}

/// Every plan ends in standstill, so no trim may be farther from it than the horizon.
void check_standstill_is_near(const Node& node, const Scenario& scenario) {
  for (const TrimId trim : scenario.subgraph->trims()) {
    const std::size_t steps = scenario.subgraph->distance_to_standstill(trim);
    if (steps <= scenario.horizon_steps) continue;
    node.fail(node.has("horizon_steps") ? "horizon_steps" : "subgraph",
              fmt::format(">= {}: trim {} of subgraph {} needs that many steps to standstill",
                          steps, trim.index + 1, scenario.subgraph->spec().name));
  }
}

void check_lab(const Scenario& scenario) {
  if (!scenario.lab) return;
  const std::string fault = automaton::validate_for_lab(*scenario.subgraph, *scenario.lab);
  if (fault.empty()) return;
  throw std::invalid_argument(
      fmt::format("{}: subgraph {}, {} by {}", scenario.automaton_file.string(),
                  scenario.subgraph->spec().name, fault, scenario.lab_file->string()));
}

/// The command line's policy, otherwise the file's.
void choose_policy(const ScenarioValues& values, const ScenarioChoices& choices,
                   Scenario& scenario) {
  scenario.policies = values.policies;
  std::string known = policy::kNoPolicy;
  for (const auto& [name, settings] : values.policies) known += ", " + name;
  const auto is_known = [&](const std::string& name) {
    return name == policy::kNoPolicy || values.policies.contains(name);
  };
  if (!is_known(values.policy)) values.node.fail("policy", "one of " + known);
  scenario.policy = choices.policy.value_or(values.policy);
  if (!is_known(scenario.policy)) {
    throw std::invalid_argument(
        fmt::format("--policy = {}, must be one of {}", one_line(scenario.policy), known));
  }
  // Policies are made for the file's own subgraph; another one may be too narrow for some of them.
  const bool is_own_subgraph = scenario.subgraph->spec().name == values.subgraph;
  for (const auto& [name, settings] : values.policies) {
    if (name != scenario.policy && !is_own_subgraph) continue;
    for (const auto& base : subgraphs_of(values, scenario.subgraph)) {
      check_policy(values.node, name, settings, *base, scenario.horizon_steps, scenario.lab);
    }
  }
  if (scenario.policy != policy::kNoPolicy) {
    scenario.reconfiguration = scenario.policies.at(scenario.policy);
  }
}

/// A zone that no route passes is a mistake: its limit would never hold.
void check_zones(const Node& node, const Scenario& scenario) {
  for (const auto& [name, settings] : scenario.policies) {
    for (std::size_t i = 0; i < settings.zones.size(); ++i) {
      const std::vector<policy::SpeedZone> zone{settings.zones[i]};
      const bool is_driven_through =
          std::ranges::any_of(scenario.routes, [&zone](const road::DrivableRoute& route) {
            return policy::limit_on(zone, route.path, 0.0, route.path.length_m()).has_value();
          });
      if (is_driven_through) continue;
      node.map("policies").map(name).list("zones")[i].fail("x_m", "a zone that a route passes");
    }
  }
}

/// Those of the file first, then those of the map.
void add_obstacles(const ScenarioValues& values, const std::vector<road::MapObstacle>& on_map,
                   Scenario& scenario) {
  for (const ObstacleValues& one : values.obstacles) {
    scenario.obstacles.push_back({.name = one.name, .area_m = one.area_m});
  }
  for (const road::MapObstacle& one : on_map) {
    for (const ConvexPolygon& area_m : one.areas_m) {
      scenario.obstacles.push_back(
          {.name = fmt::format("{} {}", one.type, one.id), .area_m = area_m});
    }
  }
}

/// @pre the vehicles are there
void check_guests(const ScenarioValues& values, const Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.guests.size(); ++i) {
    const GuestValues& one = values.guests[i];
    const bool is_vehicle = std::ranges::find(scenario.vehicles, one.id, &ScenarioVehicle::id) !=
                            scenario.vehicles.end();
    if (is_vehicle) one.node.fail("id", "none of the vehicles' ids");
    if (const std::string other = overlapped_by_guest(i, scenario); !other.empty()) {
      one.node.map("start").fail("x_m", fmt::format("a start that does not overlap {}", other));
    }
  }
}

/// Votes need a round of their own. Profile 2022 has such a rule; it plans sequentially then.
/// Comparing orders by their plans needs two rounds.
controller::Rounds rounds_of(const ScenarioValues& values, const ScenarioChoices& choices,
                             const Profile& profile) {
  const coordination::PriorityStrategy& strategy = *profile.strategies.priorities.strategy;
  const bool needs_votes = profile.strategies.coordination.commit.needs_votes;
  const bool is_sequential = values.rounds == controller::Rounds::kSequential;
  std::string why =
      unsuitable_priorities(profile.strategies.priorities, profile.strategies.coordination);
  if (why.empty() && strategy.search != nullptr && is_sequential) {
    why = "one that compares no orders with rounds: sequential";
  }
  if (!why.empty()) {
    const bool is_map = !values.node.is_value("priorities");
    if (strategy.search == nullptr)
      values.node.map("priorities").fail("max_levels", "absent " + std::string(kWithVotes));
    if (!choices.priorities && is_map) values.node.map("priorities").fail("strategy", why);
    if (!choices.priorities) values.node.fail("priorities", why);
    throw std::invalid_argument(
        fmt::format("--priorities = {}, must be {}", *choices.priorities, why));
  }
  if (!needs_votes && strategy.search != nullptr) return controller::Rounds::kTwo;
  if (!needs_votes) return values.rounds.value_or(controller::Rounds::kSequential);
  if (values.strategies.coordination && values.rounds == controller::Rounds::kTwo) {
    values.node.fail("rounds", "sequential with coordination: agreed");
  }
  return controller::Rounds::kSequential;
}

}  // namespace

Scenario assemble_scenario(const ScenarioValues& values, ScenarioInputs inputs,
                           const ScenarioChoices& choices) {
  Scenario scenario;
  scenario.file = choices.file;
  scenario.name = values.name;
  scenario.automaton_file = values.automaton_file;
  scenario.map_file = inputs.map_file;
  scenario.lab_file = values.lab_file;
  scenario.lab = inputs.lab;
  scenario.steps = choices.steps.value_or(values.steps);
  scenario.horizon_steps = values.horizon_steps;
  scenario.reference_speed_mps = values.reference_speed_mps;
  scenario.contouring_weight = values.contouring_weight;
  scenario.held_up_contouring_weight = values.held_up_contouring_weight;
  scenario.profile = profile_from_name(choices.profile);
  choose_strategies(values.strategies, scenario.profile);
  coordination::PriorityRule& priorities = scenario.profile.strategies.priorities;
  priorities = values.priorities;
  if (choices.priorities) priorities.strategy = priority_strategy_from_flag(*choices.priorities);
  scenario.rounds = rounds_of(values, choices, scenario.profile);
  scenario.search = choose_search(values, choices, scenario.profile);
  scenario.is_reconfigurable = values.is_reconfigurable;
  scenario.subgraph = inputs.subgraph;
  check_criterion_weights(values.node, values.criterion_weights, *scenario.subgraph);
  check_standstill_is_near(values.node, scenario);
  check_lab(scenario);
  check_reference_speeds(values, scenario.subgraph);
  choose_policy(values, choices, scenario);
  add_obstacles(values, inputs.map_obstacles, scenario);
  scenario.guests = guests_of(values.guests, scenario.subgraph->automaton().vehicle);
  add_vehicles(values, inputs, choices, scenario);
  check_guests(values, scenario);
  check_zones(values.node, scenario);
  std::ranges::sort(scenario.vehicles, {}, &ScenarioVehicle::id);
  return scenario;
}

}  // namespace hlc::scenario
