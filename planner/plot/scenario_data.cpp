#include "planner/plot/scenario_data.hpp"

#include "planner/plot/json_points.hpp"
#include "planner/road/lanelet_map.hpp"

namespace hlc::plot {
namespace {

using Json = nlohmann::ordered_json;

Json lanelets_of(const scenario::Scenario& scenario) {
  Json lanelets = Json::array();
  if (!scenario.map_file) return lanelets;
  for (const auto& [id, lanelet] : road::read_lanelet_map(*scenario.map_file).lanelets) {
    lanelets.push_back({{"id", id},
                        {"left_m", json_points(lanelet.left_m)},
                        {"right_m", json_points(lanelet.right_m)}});
  }
  return lanelets;
}

Json vehicle_of(const scenario::Scenario& scenario, const scenario::ScenarioVehicle& vehicle) {
  const Pose start = scenario::measured_start(scenario, vehicle);
  Json data{{"id", vehicle.id.value},
            {"name", vehicle.name},
            {"start", {{"x_m", start.x_m}, {"y_m", start.y_m}, {"yaw_rad", start.heading_rad}}},
            {"start_s_m", vehicle.start_s_m},
            {"path",
             {{"is_closed", vehicle.path.is_closed()},
              {"length_m", vehicle.path.length_m()},
              {"points_m", json_points(vehicle.path.points_m())}}}};
  if (vehicle.goal) data["goal_m"] = json_points(vehicle.goal->area_m.vertices_m);
  return data;
}

Json zones_of(const scenario::Scenario& scenario) {
  Json all = Json::object();
  for (const auto& [name, settings] : scenario.policies) {
    for (const policy::SpeedZone& zone : settings.zones) {
      all[name].push_back({{"min_x_m", zone.min_x_m},
                           {"max_x_m", zone.max_x_m},
                           {"min_y_m", zone.min_y_m},
                           {"max_y_m", zone.max_y_m},
                           {"max_speed_mps", zone.max_speed_mps}});
    }
  }
  return all;
}

}  // namespace

Json scenario_data(const scenario::Scenario& scenario) {
  const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
  const Footprint& footprint = automaton.vehicle.footprint;
  Json places{{"scenario", scenario.name},
              {"step_s", automaton.step_s},
              {"has_map", scenario.map_file.has_value()},
              {"lanelets", lanelets_of(scenario)},
              {"footprint", {{"length_m", footprint.length_m}, {"width_m", footprint.width_m}}},
              {"vehicles", Json::array()},
              {"zones", zones_of(scenario)},
              {"obstacles", Json::array()}};
  for (const scenario::ScenarioObstacle& one : scenario.obstacles) {
    places["obstacles"].push_back(
        {{"name", one.name}, {"corners_m", json_points(one.area_m.vertices_m)}});
  }
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    places["vehicles"].push_back(vehicle_of(scenario, vehicle));
  }
  return places;
}

}  // namespace hlc::plot
