#include "planner/scenario/scenario_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "planner/automaton/vehicle_yaml.hpp"
#include "planner/controller/controller_options.hpp"
#include "planner/scenario/area_values.hpp"
#include "planner/scenario/policy_file.hpp"
#include "planner/scenario/priority_values.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/search_values.hpp"

namespace hlc::scenario {
namespace {

/// A car may be started this far off its place, to test its behaviour there.
constexpr double kMostBeside_m = 10.0;
constexpr double kMostTurned_rad = std::numbers::pi;

std::filesystem::path beside(const std::filesystem::path& file, const std::string& path) {
  return (file.parent_path() / path).lexically_normal();
}

std::optional<double> read_held_up_contouring_weight(const Node& node) {
  const std::string key = "held_up_contouring_weight";
  if (!node.has(key)) return std::nullopt;
  return node.required<double>(key, between(0.0, controller::kMostContouringWeight));
}

void parse_routes(const Node& scenario, ScenarioValues& values) {
  values.has_random_routes = scenario.is_value("routes");
  if (values.has_random_routes) {
    static_cast<void>(scenario.required<std::string>("routes", one_of({kRandomRoutes})));
    return;
  }
  values.routes = read_routes(scenario);
}

std::optional<double> read_reference_speed(const Node& vehicle) {
  constexpr char kKey[] = "reference_speed_mps";
  if (!vehicle.has(kKey)) return std::nullopt;
  return vehicle.required<double>(kKey, above(0.0));
}

std::optional<ConvexPolygon> read_goal(const Node& vehicle) {
  if (!vehicle.has("goal")) return std::nullopt;
  const Node node = vehicle.map("goal");
  node.check_keys({"rectangle", "circle", "polygon"});
  return read_area(node);
}

void parse_vehicles(const Node& scenario, ScenarioValues& values) {
  for (const Node& node : scenario.list("vehicles")) {
    const VehicleId id{
        static_cast<std::uint8_t>(node.required<std::size_t>("id", between(1.0, kMaxVehicleId)))};
    if (std::ranges::find(values.vehicles, id, &VehicleValues::id) != values.vehicles.end()) {
      node.fail("id", "unique");
    }
    const bool is_random = values.has_random_routes;
    values.vehicles.push_back(
        {.id = id,
         .name = node.optional<std::string>("name", fmt::format("vehicle {}", id.value)),
         .route = is_random ? "" : node.required<std::string>("route"),
         .lanelet = is_random ? node.required<int>("lanelet", at_least(1.0)) : 0,
         .start_m = node.required<double>("start_m"),
         .start_left_m =
             node.optional<double>("start_left_m", 0.0, between(-kMostBeside_m, kMostBeside_m)),
         .start_turned_rad = node.optional<double>("start_turned_rad", 0.0,
                                                   between(-kMostTurned_rad, kMostTurned_rad)),
         .reference_speed_mps = read_reference_speed(node),
         .goal_m = read_goal(node),
         .node = node});
    node.check_no_unknown_keys();
  }
  if (values.vehicles.empty()) scenario.fail("vehicles", "a list with at least one vehicle");
}

DrawValues parse_draw(const Node& node, bool has_random_routes) {
  DrawValues draw{.cars = node.required<std::size_t>("cars", between(1.0, kMaxVehicleId)),
                  .routes = {},
                  .node = node};
  if (!has_random_routes) {
    for (const Node& route : node.list("routes")) draw.routes.push_back(route.as<std::string>());
  }
  node.check_no_unknown_keys();
  return draw;
}

CircleValues parse_circle(const Node& node) {
  CircleValues circle;
  circle.cars = node.required<std::size_t>("cars", between(1.0, kMaxCarsOnCircle));
  circle.radius_m = node.required<double>("radius_m", above(0.0));
  circle.centre_m = {node.required<double>("centre_x_m"), node.required<double>("centre_y_m")};
  node.check_no_unknown_keys();
  return circle;
}

std::optional<controller::Rounds> read_rounds(const Node& node) {
  if (!node.has("rounds")) return std::nullopt;
  return node.required<std::string>("rounds", one_of({"sequential", "two"})) == "two"
             ? controller::Rounds::kTwo
             : controller::Rounds::kSequential;
}

}  // namespace

ScenarioValues parse_scenario(const Node& node, const std::filesystem::path& path) {
  ScenarioValues values{
      .name = node.required<std::string>("name"),
      .automaton_file = beside(path, node.required<std::string>("automaton")),
      .subgraph = node.required<std::string>("subgraph"),
      .steps = node.required<std::size_t>("steps", between(1.0, 100000.0)),
      .horizon_steps = node.optional<std::size_t>("horizon_steps", 8, between(1.0, 64.0)),
      .reference_speed_mps = node.optional<double>("reference_speed_mps", 0.8,
                                                   above(0.0, automaton::kMaxVehicleSpeed_mps)),
      .contouring_weight = node.optional<double>("contouring_weight", 0.0,
                                                 between(0.0, controller::kMostContouringWeight)),
      .held_up_contouring_weight = read_held_up_contouring_weight(node),
      .strategies = read_strategies(node),
      .priorities = read_priorities(node),
      .rounds = read_rounds(node),
      .engine = read_engine(node),
      .max_expansions = read_max_expansions(node),
      .criterion_weights = read_criterion_weights(node),
      .is_reconfigurable = node.optional<bool>("reconfigurable", false),
      .policies = read_policies(node),
      .policy = node.optional<std::string>("policy", policy::kNoPolicy),
      .obstacles = read_obstacles(node),
      .guests = read_guests(node, path),
      .node = node};
  if (node.has("lab")) values.lab_file = beside(path, node.required<std::string>("lab"));
  if (node.has("circle")) {
    values.circle = parse_circle(node.map("circle"));
  } else {
    if (node.has("map")) values.map_file = beside(path, node.required<std::string>("map"));
    values.has_right_of_way = node.optional<bool>("right_of_way", false);
    parse_routes(node, values);
    if (node.has("draw")) {
      values.draw = parse_draw(node.map("draw"), values.has_random_routes);
    } else {
      parse_vehicles(node, values);
    }
    values.seed = node.optional<std::size_t>("seed", 1, between(0.0, kMaxSeed));
  }
  if (values.strategies.right_of_way_order && !values.has_right_of_way) {
    node.fail("right_of_way_order", "absent without right_of_way: true");
  }
  node.check_no_unknown_keys();
  return values;
}

}  // namespace hlc::scenario
