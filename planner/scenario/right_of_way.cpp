#include "planner/scenario/right_of_way.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/automaton/lateral_step.hpp"
#include "planner/road/driving_line.hpp"

namespace hlc::scenario {
namespace {

/// Automata that stop so much beside their line have room enough (ConflictRules::across_m). Of the
/// µCar, for others scale_of times as long.
constexpr double kNeedlessRoom_m = 0.001;

std::uint32_t number_of(const road::ReferencePath& path, std::vector<road::DrivableRoute>& routes) {
  const auto found = std::ranges::find_if(routes, [&](const road::DrivableRoute& route) {
    return route.path.points_m() == path.points_m();
  });
  const auto number = static_cast<std::uint32_t>(found - routes.begin());
  if (found == routes.end()) routes.push_back({.name = {}, .path = path, .corridor = {}});
  return number;
}

bool has_refuge(const right_of_way::ConflictMap& map, std::size_t route) {
  for (std::size_t cell = 0; cell < map.num_cells(route); ++cell) {
    if (!map.is_conflict(route, cell)) return true;
  }
  return false;
}

/// A car on a route without a refuge would have to be granted all of it at once.
void demand_refuge(const Scenario& scenario, std::uint32_t route, const std::string& whose) {
  if (has_refuge(*scenario.conflicts, route)) return;
  throw std::invalid_argument(
      fmt::format("{}: right_of_way: the route of {} must have a place where a car may wait; all "
                  "of it crosses or meets other routes",
                  scenario.file.string(), whose));
}

/// No authority reaches past an obstacle in a cell of the route: its vehicles would stand before it
/// forever.
void demand_clear_road(const Scenario& scenario, std::uint32_t route, const std::string& whose) {
  const right_of_way::ConflictMap& map = *scenario.conflicts;
  for (std::size_t cell = 0; cell < map.num_cells(route); ++cell) {
    for (const ScenarioObstacle& one : scenario.obstacles) {
      if (!intersects(map.area_m(route, cell), one.area_m)) continue;
      const Point place_m = map.place_m(route, cell);
      throw std::invalid_argument(
          fmt::format("{}: obstacles: with right_of_way, {} must be beside the route of {}: nobody "
                      "would be granted the road past it, at ({:.3f}, {:.3f})",
                      scenario.file.string(), one.name, whose, place_m.x(), place_m.y()));
    }
  }
}

void check_routes(const Scenario& scenario) {
  const auto demand = [&](std::uint32_t route, const std::string& whose) {
    demand_refuge(scenario, route, whose);
    demand_clear_road(scenario, route, whose);
  };
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    demand(vehicle.route_number,
           fmt::format("vehicle {} ({})", int{vehicle.id.value}, vehicle.name));
  }
  for (const road::DrivableRoute& route : scenario.routes) demand(route.number, route.name);
}

}  // namespace

void relate_routes(Scenario& scenario) {
  if (!scenario.shared_lane_width_m) return;
  std::vector<road::DrivableRoute> routes;
  for (road::DrivableRoute& route : scenario.routes) route.number = number_of(route.path, routes);
  for (ScenarioVehicle& vehicle : scenario.vehicles) {
    vehicle.route_number = number_of(vehicle.path, routes);
  }
  std::vector<road::ReferencePath> paths;
  std::ranges::transform(routes, std::back_inserter(paths), &road::DrivableRoute::path);
  const vehicle::VehicleParameters& parameters = scenario.subgraph->automaton().vehicle;
  std::vector<road::DrivingLine> lines =
      road::driving_lines(paths, *scenario.shared_lane_width_m, parameters.footprint);
  for (std::size_t i = 0; i < routes.size(); ++i) routes[i].driving_line = lines[i];
  for (road::DrivableRoute& route : scenario.routes) route.driving_line = lines[route.number];
  for (ScenarioVehicle& vehicle : scenario.vehicles) {
    vehicle.driving_line = lines[vehicle.route_number];
  }
  right_of_way::ConflictRules rules =
      scenario.random_routes_on ? right_of_way::kTours : right_of_way::ConflictRules{};
  const double lateral_m =
      automaton::lateral_step_m(*scenario.subgraph) / scale_of(parameters.footprint);
  if (lateral_m > kNeedlessRoom_m) rules.stopping_room_m = lateral_m;
  scenario.conflicts = std::make_shared<const right_of_way::ConflictMap>(routes, parameters, rules);
  check_routes(scenario);
}

}  // namespace hlc::scenario
