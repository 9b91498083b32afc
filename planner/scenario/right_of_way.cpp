#include "planner/scenario/right_of_way.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "planner/road/driving_line.hpp"

namespace hlc::scenario {
namespace {

std::uint32_t number_of(const road::ReferencePath& path, std::vector<road::DrivableRoute>& routes) {
  const auto found = std::ranges::find_if(routes, [&](const road::DrivableRoute& route) {
    return route.path.points_m() == path.points_m();
  });
  const auto number = static_cast<std::uint32_t>(found - routes.begin());
  if (found == routes.end()) routes.push_back({.name = {}, .path = path, .corridor = {}});
  return number;
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
  scenario.conflicts = std::make_shared<const right_of_way::ConflictMap>(routes, parameters);
}

}  // namespace hlc::scenario
