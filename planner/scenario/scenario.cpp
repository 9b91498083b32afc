#include "planner/scenario/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "planner/automaton/lab_check.hpp"
#include "planner/common/yaml_reader.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/policy/speed_zones.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/road/route.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/lab_file.hpp"
#include "planner/scenario/named_subgraph.hpp"
#include "planner/scenario/policy_file.hpp"
#include "planner/scenario/starts.hpp"
#include "planner/search/edge_costs.hpp"
#include "planner/search/search_options.hpp"

namespace hlc {
namespace {

constexpr std::size_t kMaxCars = 20;
/// A car may be started so far off its place, to see what becomes of it.
constexpr double kMostBeside_m = 10.0;
constexpr double kMostTurned_rad = std::numbers::pi;

std::filesystem::path beside(const std::filesystem::path& file, const std::string& path) {
  return (file.parent_path() / path).lexically_normal();
}

VehicleId vehicle_id(const YamlNode& node) {
  return {static_cast<std::uint8_t>(node.required<std::size_t>("id", between(1.0, kMaxVehicleId)))};
}

/// Routes by name, for the map that is driven on.
std::map<std::string, Route> read_routes(const YamlNode& scenario, const LaneletMap& map) {
  std::map<std::string, Route> routes;
  for (const YamlNode& node : scenario.list("routes")) {
    const auto name = node.required<std::string>("name");
    const bool closed = node.optional<bool>("closed", true);
    const YamlNode by_map = node.map("lanelets");
    if (!by_map.has(map.benchmark_id)) {
      node.fail("lanelets", "a list for the map with benchmarkID " + map.benchmark_id);
    }
    std::vector<LaneletId> lanelets;
    for (const YamlNode& lanelet : by_map.list(map.benchmark_id)) {
      lanelets.push_back(lanelet.as<int>(at_least(1.0)));
      if (!map.lanelets.contains(lanelets.back())) {
        lanelet.fail("a lanelet of the map " + map.benchmark_id);
      }
    }
    node.check_no_unknown_keys();
    try {
      routes.emplace(name, build_route(map, lanelets, closed));
    } catch (const std::runtime_error& error) {
      by_map.fail(map.benchmark_id, std::string("a route that can be driven: ") + error.what());
    }
  }
  return routes;
}

void read_vehicles(const YamlNode& node, const ScenarioChoices& choices, Scenario& scenario) {
  if (choices.cars) {
    throw std::invalid_argument("--cars: " + choices.file.string() +
                                " has named vehicles; allowed for scenarios with `circle`");
  }
  scenario.map_file = choices.map_file ? *choices.map_file
                                       : beside(choices.file, node.required<std::string>("map"));
  static_cast<void>(node.optional<std::string>("map", ""));
  const std::map<std::string, Route> routes =
      read_routes(node, read_lanelet_map(*scenario.map_file));
  for (const auto& [name, route] : routes) {
    scenario.routes.push_back({.name = name, .path = route.path, .corridor = route.corridor});
  }
  for (const YamlNode& entry : node.list("vehicles")) {
    const VehicleId id = vehicle_id(entry);
    const auto route = routes.find(entry.required<std::string>("route"));
    if (route == routes.end()) entry.fail("route", "the name of an entry of `routes`");
    const double start_m =
        entry.required<double>("start_m", between(0.0, route->second.path.length_m()));
    const double left_m =
        entry.optional<double>("start_left_m", 0.0, between(-kMostBeside_m, kMostBeside_m));
    const double turned_rad =
        entry.optional<double>("start_turned_rad", 0.0, between(-kMostTurned_rad, kMostTurned_rad));
    const double heading_rad = route->second.path.heading_rad_at(start_m);
    const Point position = route->second.path.at(start_m) +
                           left_m * Point(-std::sin(heading_rad), std::cos(heading_rad));
    scenario.vehicles.push_back(
        {.id = id,
         .name = entry.optional<std::string>("name", "vehicle " + std::to_string(id.value)),
         .start = {position.x(), position.y(), wrap_angle(heading_rad + turned_rad)},
         .start_s_m = start_m,
         .path = route->second.path,
         .corridor = route->second.corridor});
    entry.check_no_unknown_keys();
  }
}

/// Cars evenly on a circle, each on the straight line to the opposite point; no lanes.
void read_circle(const YamlNode& node, const ScenarioChoices& choices, Scenario& scenario) {
  if (choices.map_file) {
    throw std::invalid_argument("--map: " + choices.file.string() +
                                " is a scenario without lanes; allowed for scenarios with `map`");
  }
  const YamlNode circle = node.map("circle");
  const auto configured = circle.required<std::size_t>("cars", between(1.0, kMaxCars));
  const std::size_t cars = choices.cars.value_or(configured);
  if (cars < 1 || cars > kMaxCars) {
    throw std::invalid_argument("--cars = " + std::to_string(cars) + ", allowed 1 ... " +
                                std::to_string(kMaxCars));
  }
  const double radius = circle.required<double>("radius_m", above(0.0));
  const Point centre{circle.required<double>("centre_x_m"), circle.required<double>("centre_y_m")};
  circle.check_no_unknown_keys();
  for (std::size_t i = 0; i < cars; ++i) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(cars);
    const Point offset = radius * Point(std::cos(angle), std::sin(angle));
    const Point start = centre + offset;
    scenario.vehicles.push_back(
        {.id = {static_cast<std::uint8_t>(i + 1)},
         .name = "car " + std::to_string(i + 1),
         .start = {start.x(), start.y(), wrap_angle(angle + std::numbers::pi)},
         .start_s_m = 0.0,
         .path = ReferencePath({start, centre - offset}, false),
         .corridor = {}});
    const ScenarioVehicle& car = scenario.vehicles.back();
    scenario.routes.push_back({.name = car.name, .path = car.path, .corridor = car.corridor});
  }
}

/// Every plan ends in standstill, so no trim may be farther from it than the horizon.
void check_standstill_is_near(const YamlNode& node, const Scenario& scenario) {
  for (const TrimId trim : scenario.subgraph->trims()) {
    const std::size_t steps = scenario.subgraph->distance_to_standstill(trim);
    if (steps <= scenario.horizon_steps) continue;
    node.fail(node.has("horizon_steps") ? "horizon_steps" : "subgraph",
              "a horizon of at least " + std::to_string(steps) + " steps: so many takes trim " +
                  std::to_string(trim.index + 1) + " of subgraph " +
                  scenario.subgraph->spec().name + " to standstill");
  }
}

/// What the lab's vehicles can follow, if the scenario is for a lab.
void read_lab_of(const YamlNode& node, const ScenarioChoices& choices, Scenario& scenario) {
  if (!node.has("lab")) return;
  scenario.lab_file = beside(choices.file, node.required<std::string>("lab"));
  scenario.lab = read_lab(*scenario.lab_file, scenario.subgraph->automaton().step_s);
  const std::string fault = lab_fault_of(*scenario.subgraph, *scenario.lab);
  if (fault.empty()) return;
  throw std::invalid_argument(scenario.automaton_file.string() + ": subgraph " +
                              scenario.subgraph->spec().name + ", " + fault + " by " +
                              scenario.lab_file->string());
}

void check_vehicles(const YamlNode& node, const Scenario& scenario) {
  if (scenario.vehicles.empty()) node.fail("vehicles", "at least one");
  const std::vector<YamlNode> entries = node.optional_list("vehicles");  // none on a circle
  for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (scenario.vehicles[j].id == scenario.vehicles[i].id)
        entries[i].fail("id", "every id once");
    }
  }
  if (const auto overlap = overlapping_starts(scenario)) {
    const auto [first, second] = *overlap;
    const std::string allowed =
        "start poses whose footprints with margin do not overlap: those of vehicles " +
        std::to_string(scenario.vehicles[first].id.value) + " and " +
        std::to_string(scenario.vehicles[second].id.value) + " do";
    if (entries.empty()) node.fail("circle", allowed);
    entries[second].fail("start_m", allowed);
  }
}

const SubgraphSpec& chosen_subgraph(const YamlNode& node, const ScenarioChoices& choices,
                                    const std::vector<SubgraphSpec>& subgraphs) {
  const auto configured = node.required<std::string>("subgraph");
  const std::string name = choices.subgraph.value_or(configured);
  if (const SubgraphSpec* spec = find_subgraph(subgraphs, name)) return *spec;
  if (choices.subgraph) {
    throw std::invalid_argument("subgraph " + name + ", allowed " + names_of(subgraphs));
  }
  node.fail("subgraph", names_of(subgraphs));
}

/// The command line's engine, else the file's, else the profile's.
SearchOptions read_search(const YamlNode& node, const ScenarioChoices& choices,
                          const Profile& profile) {
  SearchOptions search{.engine = profile.engine, .cost_to_go = profile.cost_to_go};
  search.max_expansions =
      node.optional<std::size_t>("max_expansions", search.max_expansions,
                                 between(1.0, static_cast<double>(SearchOptions::kMostExpansions)));
  if (const auto name = node.optional<std::string>("engine", ""); node.has("engine")) {
    try {
      choose_engine(name, search);
    } catch (const std::invalid_argument&) {
      node.fail("engine", kEngineChoices);
    }
  }
  try {
    if (choices.engine) choose_engine(*choices.engine, search);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("--") + error.what());
  }
  try {
    check_search_options(search);
  } catch (const std::invalid_argument& error) {
    if (choices.engine) {
      throw std::invalid_argument(
          "--engine = " + *choices.engine + " with profile " + profile.name +
          ", allowed best_first or ompl_best_first: the profile's cost-to-go is " +
          to_string(search.cost_to_go));
    }
    node.fail("engine", "with profile " + profile.name + ": " + error.what());
  }
  return search;
}

std::vector<PlanningWeight> read_criterion_weights(const YamlNode& node, const Subgraph& subgraph) {
  const YamlNode weights = node.optional_map("criterion_weights");
  const std::vector<std::string> known = criteria_of(subgraph);
  std::vector<PlanningWeight> result;
  for (const std::string& criterion : weights.keys()) {
    result.push_back({criterion, weights.required<double>(
                                     criterion, between(0.0, SearchOptions::kMostWeight_m2))});
    if (std::ranges::find(known, criterion) != known.end()) continue;
    std::string allowed = "criteria of the automaton's maneuvers:";
    for (const std::string& name : known) allowed += " " + name;
    weights.fail(criterion, allowed);
  }
  return result;
}

/// The command line's, else the file's, else none.
void read_reconfiguration(const YamlNode& node, const ScenarioChoices& choices,
                          Scenario& scenario) {
  scenario.policies = read_policies(node);
  const auto configured = node.optional<std::string>("policy", kNoPolicy);
  std::string known = kNoPolicy;
  for (const auto& [name, settings] : scenario.policies) known += ", " + name;
  const auto is_known = [&](const std::string& name) {
    return name == kNoPolicy || scenario.policies.contains(name);
  };
  if (!is_known(configured)) node.fail("policy", known);
  scenario.policy = choices.policy.value_or(configured);
  if (!is_known(scenario.policy)) {
    throw std::invalid_argument("--policy = " + one_line(scenario.policy) + ", allowed " + known);
  }
  // Policies are made for the file's own subgraph; another one may be too narrow for some of them.
  const bool is_own_subgraph =
      scenario.subgraph->spec().name == node.required<std::string>("subgraph");
  for (const auto& [name, settings] : scenario.policies) {
    if (name != scenario.policy && !is_own_subgraph) continue;
    check_policy(node, name, settings, *scenario.subgraph, scenario.horizon_steps, scenario.lab);
  }
  if (scenario.policy != kNoPolicy) {
    scenario.reconfiguration = scenario.policies.at(scenario.policy);
  }
}

/// A zone that nobody comes through is a mistake: where it should be, nobody would slow down.
void check_zones(const YamlNode& node, const Scenario& scenario) {
  for (const auto& [name, settings] : scenario.policies) {
    const YamlNode policy = node.map("policies").map(name);
    const std::vector<YamlNode> entries = policy.optional_list("zones");
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const std::vector<SpeedZone> zone{settings.zones[i]};
      const bool is_driven_through =
          std::ranges::any_of(scenario.routes, [&zone](const DrivableRoute& route) {
            return limit_on(zone, route.path, 0.0, route.path.length_m()).has_value();
          });
      if (!is_driven_through) entries[i].fail("x_m", "a zone that a route comes through");
    }
  }
}

Scenario read_with(const YamlNode& node, const ScenarioChoices& choices,
                   std::shared_ptr<const Subgraph> subgraph) {
  Scenario scenario;
  scenario.file = choices.file;
  scenario.name = node.required<std::string>("name");
  scenario.automaton_file = beside(choices.file, node.required<std::string>("automaton"));
  const auto steps = node.required<std::size_t>("steps", between(1.0, 100000.0));
  scenario.steps = choices.steps.value_or(steps);
  scenario.horizon_steps = node.optional<std::size_t>("horizon_steps", 8, between(1.0, 64.0));
  scenario.reference_speed_mps = node.optional<double>("reference_speed_mps", 0.8, above(0.0));
  scenario.profile = profile_from_name(choices.profile);
  scenario.search = read_search(node, choices, scenario.profile);
  scenario.is_reconfigurable = node.optional<bool>("reconfigurable", false);
  scenario.subgraph = std::move(subgraph);
  scenario.search.criterion_weights = read_criterion_weights(node, *scenario.subgraph);
  check_standstill_is_near(node, scenario);
  read_lab_of(node, choices, scenario);
  read_reconfiguration(node, choices, scenario);
  if (node.has("circle")) {
    read_circle(node, choices, scenario);
  } else {
    read_vehicles(node, choices, scenario);
  }
  node.check_no_unknown_keys();
  check_vehicles(node, scenario);
  check_zones(node, scenario);
  std::ranges::sort(scenario.vehicles, {}, &ScenarioVehicle::id);
  return scenario;
}

}  // namespace

Scenario read_scenario(const ScenarioChoices& choices) {
  const YamlNode node = YamlNode::read_file(choices.file);
  const std::filesystem::path path = beside(choices.file, node.required<std::string>("automaton"));
  const bool may_ask_for_more =
      node.optional<bool>("reconfigurable", false) || node.has("policies");
  const BuildScope scope = may_ask_for_more ? BuildScope::kWhole : BuildScope::kSubgraph;
  const auto choose = [&](const std::vector<SubgraphSpec>& offered) -> const SubgraphSpec& {
    return chosen_subgraph(node, choices, offered);
  };
  return read_with(node, choices, read_subgraph(path, choose, scope));
}

Scenario read_scenario(const ScenarioChoices& choices,
                       std::shared_ptr<const UniversalAutomaton> automaton,
                       const std::vector<SubgraphSpec>& subgraphs) {
  const YamlNode node = YamlNode::read_file(choices.file);
  const SubgraphSpec& spec = chosen_subgraph(node, choices, subgraphs);
  return read_with(node, choices, std::make_shared<Subgraph>(std::move(automaton), spec));
}

std::vector<std::filesystem::path> files_of(const Scenario& scenario) {
  std::vector<std::filesystem::path> files{scenario.file, scenario.automaton_file};
  if (scenario.map_file) files.push_back(*scenario.map_file);
  if (scenario.lab_file) files.push_back(*scenario.lab_file);
  return files;
}

const ScenarioVehicle& vehicle_of(const Scenario& scenario, VehicleId id) {
  const auto found = std::ranges::find(scenario.vehicles, id, &ScenarioVehicle::id);
  if (found != scenario.vehicles.end()) return *found;
  std::string known;
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    known += (known.empty() ? "" : ", ") + std::to_string(vehicle.id.value);
  }
  throw std::invalid_argument(scenario.file.string() +
                              ": vehicle id = " + std::to_string(id.value) + ", allowed " + known);
}

std::unique_ptr<Controller> make_controller(const Scenario& scenario, VehicleId id) {
  std::vector<DrivableRoute> routes = scenario.routes;
  const auto named = std::ranges::find(scenario.vehicles, id, &ScenarioVehicle::id);
  if (named != scenario.vehicles.end()) {
    routes = {{.name = named->name, .path = named->path, .corridor = named->corridor}};
  }
  return std::make_unique<Controller>(
      ControllerOptions{.vehicle = id,
                        .horizon_steps = scenario.horizon_steps,
                        .reference_speed_mps = scenario.reference_speed_mps,
                        .reference_rule = scenario.profile.reference_rule,
                        .settle_rule = scenario.profile.settle_rule,
                        .search = scenario.search,
                        .lab = scenario.lab},
      scenario.subgraph, std::move(routes));
}

Pose measured_start(const Scenario& scenario, const ScenarioVehicle& vehicle) {
  const UniversalAutomaton& automaton = scenario.subgraph->automaton();
  Pose pose = vehicle.start;
  pose.heading_rad = wrap_angle(
      pose.heading_rad + yaw_minus_heading_rad(0.0, automaton.vehicle, automaton.identified));
  return pose;
}

}  // namespace hlc
