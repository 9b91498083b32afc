#include "planner/scenario/scenario_vehicles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "planner/road/route.hpp"
#include "planner/scenario/reference_speeds.hpp"
#include "planner/scenario/right_of_way.hpp"
#include "planner/scenario/starts.hpp"

namespace hlc::scenario {
namespace {

using Routes = std::map<std::string, road::Route>;

road::Route build_route_of(const RouteValues& values, const road::LaneletMap& map) {
  const auto lanelets = values.lanelets.find(map.benchmark_id);
  if (lanelets == values.lanelets.end()) {
    values.node.fail("lanelets", "a list for the map with benchmarkID " + map.benchmark_id);
  }
  const Node by_map = values.node.map("lanelets");
  const std::vector<Node> listed = by_map.list(map.benchmark_id);
  for (const Node& one : listed) {
    if (map.lanelets.contains(one.as<int>())) continue;
    one.fail("a lanelet of the map " + map.benchmark_id);
  }
  try {
    road::Route route = road::build_route(map, lanelets->second, values.is_closed);
    route.speed_sections = speed_sections_of(values, route, map.benchmark_id);
    return route;
  } catch (const std::runtime_error& error) {
    by_map.fail(map.benchmark_id, fmt::format("a route that can be driven: {}", error.what()));
  }
}

/// The lanelet of a vehicle with a random route, as a route.
road::Route start_lanelet_of(const VehicleValues& values, const road::LaneletMap& map) {
  try {
    return road::build_route(map, {values.lanelet}, false);
  } catch (const std::runtime_error& error) {
    values.node.fail("lanelet", fmt::format("a lanelet of the map: {}", error.what()));
  }
}

/// The vehicle standing on the route, heading along it.
ScenarioVehicle vehicle_on(const road::Route& route, double start_m) {
  const Point position = route.path.at(start_m);
  const auto next =
      std::upper_bound(route.lanelet_s_m.begin() + 1, route.lanelet_s_m.end() - 1, start_m);
  const auto lanelet = static_cast<std::size_t>(next - route.lanelet_s_m.begin()) - 1;
  return {.id = {},
          .name = {},
          .start = {position.x(), position.y(), route.path.heading_rad_at(start_m)},
          .start_s_m = start_m,
          .start_lanelet = route.lanelets[lanelet],
          .path = route.path,
          .corridor = route.corridor,
          .speed_sections = route.speed_sections};
}

ScenarioVehicle place_vehicle(const VehicleValues& values, const road::Route& route) {
  // A range that bounds every arc length: only the route's own bounds hold.
  static_cast<void>(values.node.required<double>("start_m", between(0.0, route.path.length_m())));
  ScenarioVehicle vehicle = vehicle_on(route, values.start_m);
  vehicle.id = values.id;
  vehicle.name = values.name;
  vehicle.reference_speed_mps = values.reference_speed_mps;
  const double heading_rad = vehicle.start.heading_rad;
  const Point position = vehicle.start.position_m() +
                         values.start_left_m * Point(-std::sin(heading_rad), std::cos(heading_rad));
  vehicle.start = {position.x(), position.y(), wrap_angle(heading_rad + values.start_turned_rad)};
  return vehicle;
}

/// Its path ends in the middle of the first stretch in its goal.
void lead_to_goal(const VehicleValues& values, ScenarioVehicle& vehicle) {
  const auto stretch = road::first_stretch_in(vehicle.path, *values.goal_m, vehicle.start_s_m);
  if (!stretch) {
    values.node.fail("goal", fmt::format("a region that the route of vehicle {} ({}) enters after "
                                         "its start",
                                         vehicle.id.value, vehicle.name));
  }
  const double end_s_m = std::midpoint(stretch->from_s_m, stretch->to_s_m);
  vehicle.speed_sections = road::sections_until(vehicle.speed_sections, vehicle.path, end_s_m);
  vehicle.path = road::path_until(vehicle.path, end_s_m);
  vehicle.goal = road::Goal{.area_m = *values.goal_m, .from_s_m = stretch->from_s_m};
}

const road::Route& route_of(const VehicleValues& values, const Routes& routes) {
  const auto route = routes.find(values.route);
  if (route == routes.end()) values.node.fail("route", "the name of an entry of `routes`");
  return route->second;
}

void add_named_vehicles(const ScenarioValues& values, const road::LaneletMap& map,
                        const Routes& routes, Scenario& scenario) {
  for (const VehicleValues& one : values.vehicles) {
    ScenarioVehicle vehicle = place_vehicle(
        one, values.has_random_routes ? start_lanelet_of(one, map) : route_of(one, routes));
    if (scenario.random_routes_on) {
      try {
        vehicle = on_random_route(std::move(vehicle), map, scenario.seed);
      } catch (const std::runtime_error& error) {
        one.node.fail(values.has_random_routes ? "lanelet" : "start_m",
                      fmt::format("a start for a random route: {}", error.what()));
      }
    }
    if (one.goal_m) lead_to_goal(one, vehicle);
    scenario.vehicles.push_back(std::move(vehicle));
  }
}

/// In the middle of each lanelet that is the only way on from those before it: not on a crossing.
void add_lanelets(const road::LaneletMap& map, Scenario& scenario) {
  const auto leads_to_one = [&](road::LaneletId before) {
    return map.lanelets.at(before).successors.size() == 1;
  };
  for (const auto& [id, lanelet] : map.lanelets) {
    if (!std::ranges::all_of(lanelet.predecessors, leads_to_one)) continue;
    const road::Route route = road::build_route(map, {id}, false);
    scenario.candidates.push_back(vehicle_on(route, route.path.length_m() / 2.0));
    scenario.candidates.back().name = fmt::format("from {}", id);
  }
}

void add_named_routes(const DrawValues& draw, const Routes& routes, Scenario& scenario) {
  const std::vector<Node> listed = draw.node.list("routes");
  for (std::size_t i = 0; i < draw.routes.size(); ++i) {
    const auto route = routes.find(draw.routes[i]);
    if (route == routes.end()) listed[i].fail("the name of an entry of `routes`");
    scenario.candidates.push_back(vehicle_on(route->second, 0.0));
    scenario.candidates.back().name = draw.routes[i];
  }
}

void add_further_candidates(const DrawValues& draw, const Routes& routes, Scenario& scenario) {
  for (const std::string& name : draw.routes) {
    const road::Route& route = routes.at(name);
    for (std::size_t i = 1; i < route.lanelets.size(); ++i) {
      scenario.further_candidates.push_back(vehicle_on(route, route.lanelet_s_m[i]));
      scenario.further_candidates.back().name = fmt::format("{} at {}", name, route.lanelets[i]);
    }
  }
}

void add_drawn_cars(const DrawValues& draw, const Routes& routes, const ScenarioChoices& choices,
                    Scenario& scenario) {
  const std::size_t cars = choices.cars.value_or(draw.cars);
  const auto draw_most = [&] {
    return draw_cars(scenario, std::min<std::size_t>(cars, kMaxVehicleId), scenario.seed);
  };
  try {
    scenario.vehicles = draw_most();
    if (scenario.vehicles.size() < cars) {
      add_further_candidates(draw, routes, scenario);
      scenario.vehicles = draw_most();
    }
  } catch (const std::runtime_error& error) {
    draw.node.fail(draw.routes.empty() ? "cars" : "routes",
                   fmt::format("starts for random routes: {}", error.what()));
  }
  const std::size_t fitting = scenario.vehicles.size();
  if (fitting == cars) return;
  const std::string allowed =
      fmt::format("in 1 ... {}: no more cars fit on {}", fitting,
                  draw.routes.empty() ? "the map's lanes" : "the routes of `draw`");
  if (!choices.cars) draw.node.fail("cars", allowed);
  throw std::invalid_argument(fmt::format("--cars = {}, must be {}", cars, allowed));
}

void add_vehicles_on_map(const ScenarioValues& values, const road::LaneletMap& map,
                         const ScenarioChoices& choices, Scenario& scenario) {
  if (values.has_random_routes || choices.routes) {
    scenario.random_routes_on = std::make_shared<const road::LaneletMap>(map);
  }
  Routes routes;
  for (const RouteValues& one : values.routes) {
    const auto& [named, is_new] = routes.emplace(one.name, build_route_of(one, map));
    if (!is_new || one.begins_elsewhere || scenario.random_routes_on) continue;
    const road::Route& route = named->second;
    scenario.routes.push_back({.name = one.name,
                               .path = route.path,
                               .corridor = route.corridor,
                               .speed_sections = route.speed_sections});
  }
  std::ranges::sort(scenario.routes, {}, &road::DrivableRoute::name);
  scenario.seed = choices.seed.value_or(values.seed);
  if (values.draw) {
    if (values.has_random_routes) {
      add_lanelets(map, scenario);
    } else {
      add_named_routes(*values.draw, routes, scenario);
    }
    add_drawn_cars(*values.draw, routes, choices, scenario);
  } else {
    add_named_vehicles(values, map, routes, scenario);
  }
  if (scenario.random_routes_on) scenario.routes = routes_of(scenario.vehicles);
  if (values.has_right_of_way) {
    for (const VehicleValues& one : values.vehicles) {
      if (one.goal_m) one.node.fail("goal", "absent with right_of_way, whose routes have no end");
    }
    const auto is_open = [](const auto& one) { return !one.path.is_closed(); };
    if (std::ranges::any_of(scenario.routes, is_open)) {
      values.node.fail("right_of_way", "false: an open route is not supported");
    }
    scenario.shared_lane_width_m = road::narrowest_lane_m(map);
    relate_routes(scenario);
  }
}

/// Cars evenly on a circle, each on the straight line to the opposite point; no lanes.
void add_cars_on_circle(const CircleValues& circle, std::size_t cars, Scenario& scenario) {
  if (cars < 1 || cars > kMaxCarsOnCircle) {
    throw std::invalid_argument(
        fmt::format("--cars = {}, must be in 1 ... {}", cars, kMaxCarsOnCircle));
  }
  for (std::size_t i = 0; i < cars; ++i) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(cars);
    const Point offset = circle.radius_m * Point(std::cos(angle), std::sin(angle));
    const Point start = circle.centre_m + offset;
    scenario.vehicles.push_back(
        {.id = {static_cast<std::uint8_t>(i + 1)},
         .name = fmt::format("car {}", i + 1),
         .start = {start.x(), start.y(), wrap_angle(angle + std::numbers::pi)},
         .start_s_m = 0.0,
         .start_lanelet = 0,
         .path = road::ReferencePath({start, circle.centre_m - offset}, false),
         .corridor = {}});
  }
  scenario.routes = routes_of(scenario.vehicles);
}

void check_starts(const ScenarioValues& values, const Scenario& scenario) {
  if (const auto inside = start_in_obstacle(scenario)) {
    const ScenarioVehicle& vehicle = scenario.vehicles[inside->first];
    const std::string clear = fmt::format(
        "clear of the footprint with margin of vehicle {} ({}) at its start, ({:.3f}, "
        "{:.3f})",
        vehicle.id.value, vehicle.name, vehicle.start.x_m, vehicle.start.y_m);
    if (inside->second < values.obstacles.size()) {
      values.obstacles[inside->second].node.fail("name", clear);
    }
    throw std::invalid_argument(fmt::format("{}: {}, must be {}", scenario.map_file->string(),
                                            scenario.obstacles[inside->second].name, clear));
  }
  const auto overlap = overlapping_starts(scenario);
  if (!overlap) return;
  const auto [first, second] = *overlap;
  const std::string allowed = fmt::format(
      "start poses whose footprints with margin do not overlap: those of vehicles {} and {} do",
      scenario.vehicles[first].id.value, scenario.vehicles[second].id.value);
  if (values.circle) values.node.fail("circle", allowed);
  values.vehicles[second].node.fail("start_m", allowed);
}

/// Flags that need another kind of scenario.
void check_choices(const ScenarioValues& values, const ScenarioChoices& choices) {
  const auto refuse = [&](const char* flag, const char* has, const char* needed) {
    throw std::invalid_argument(fmt::format("{}: {} has {}; must be a scenario with {}", flag,
                                            choices.file.string(), has, needed));
  };
  if (choices.routes && choices.routes != kRandomRoutes) {
    throw std::invalid_argument(
        fmt::format("--routes = {}, must be {}", *choices.routes, kRandomRoutes));
  }
  if (choices.routes && values.circle) refuse("--routes", "no lanes", "`map`");
  if (choices.cars && !values.circle && !values.draw) {
    refuse("--cars", "named vehicles", "`circle` or `draw`");
  }
  if (choices.seed && !values.draw && !values.has_random_routes && !choices.routes) {
    refuse("--seed", "nothing to draw", "`draw` or random routes");
  }
}

}  // namespace

void add_vehicles(const ScenarioValues& values, const ScenarioInputs& inputs,
                  const ScenarioChoices& choices, Scenario& scenario) {
  check_choices(values, choices);
  if (values.circle) {
    add_cars_on_circle(*values.circle, choices.cars.value_or(values.circle->cars), scenario);
  } else {
    add_vehicles_on_map(values, inputs.map.value(), choices, scenario);
  }
  check_starts(values, scenario);
}

}  // namespace hlc::scenario
