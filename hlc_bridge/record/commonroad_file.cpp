#include "hlc_bridge/record/commonroad_file.hpp"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>

#include "planner/common/demand.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc {
namespace {

enum class Steering { kWritten, kLeftOut };

/// A quantity with one value.
struct Exact {
  const char* name;
  double value;
};

std::ostream& operator<<(std::ostream& xml, const Exact& exact) {
  return xml << '<' << exact.name << "><exact>" << exact.value << "</exact></" << exact.name << '>';
}

void write_state(std::ostream& xml, const State& state, std::size_t time, Steering steering) {
  xml << "<position><point><x>" << state.pose.x_m << "</x><y>" << state.pose.y_m
      << "</y></point></position>" << Exact{"orientation", wrap_angle(state.pose.heading_rad)}
      << "<time><exact>" << time << "</exact></time>" << Exact{"velocity", state.speed_mps};
  if (steering == Steering::kWritten) xml << Exact{"steeringAngle", state.steering_rad};
}

void write_motion(std::ostream& xml, int id, const Footprint& footprint,
                  const std::vector<State>& states, Steering steering) {
  HLC_DEMAND(states.size() >= 2, states.size());
  xml << "  <dynamicObstacle id=\"" << id << "\">\n    <type>car</type>\n    <shape><rectangle>"
      << "<length>" << footprint.length_m << "</length><width>" << footprint.width_m
      << "</width></rectangle></shape>\n    <initialState>";
  write_state(xml, states.front(), 0, steering);
  xml << "</initialState>\n    <trajectory>\n";
  for (std::size_t i = 1; i < states.size(); ++i) {
    xml << "      <state>";
    write_state(xml, states[i], i, steering);
    xml << "</state>\n";
  }
  xml << "    </trajectory>\n  </dynamicObstacle>\n";
}

void write_problem(std::ostream& xml, int id, const VehicleParameters& vehicle,
                   const std::vector<State>& planned) {
  const State& start = planned.front();
  const double yaw_rate_radps = start.speed_mps * curvature_per_m(start.steering_rad, vehicle);
  xml << "  <planningProblem id=\"" << id << "\">\n    <initialState>";
  write_state(xml, start, 0, Steering::kLeftOut);
  xml << Exact{"yawRate", yaw_rate_radps}
      << Exact{"slipAngle", slip_angle_rad(start.steering_rad, vehicle)}
      << "</initialState>\n    <goalState><time><intervalStart>" << planned.size() - 1
      << "</intervalStart><intervalEnd>" << planned.size() - 1
      << "</intervalEnd></time></goalState>\n  </planningProblem>\n";
}

void check_ids(const LaneletMap& map) {
  if (!map.lanelets.empty() && map.lanelets.rbegin()->first > kProblemIds) {
    throw std::runtime_error(map.benchmark_id + ": lanelet " +
                             std::to_string(map.lanelets.rbegin()->first) + ", allowed ids up to " +
                             std::to_string(kProblemIds));
  }
}

}  // namespace

std::string commonroad_xml(const LaneletMap& map, const VehicleParameters& vehicle,
                           const std::vector<ExportedVehicle>& vehicles, double time_step_s) {
  check_ids(map);
  std::ostringstream xml;
  xml.imbue(std::locale::classic());
  xml << std::fixed << std::setprecision(9);
  xml << commonroad_head({.benchmark_id = map.benchmark_id,
                          .author = "export_commonroad",
                          .source = "run",
                          .time_step = shortest_text(time_step_s)});
  xml << lanelets_to_xml(map);
  for (const ExportedVehicle& one : vehicles) {
    write_motion(xml, kPlannedIds + one.id.value, vehicle.footprint, one.planned,
                 Steering::kWritten);
    write_motion(xml, kDrivenIds + one.id.value, vehicle.footprint, one.driven, Steering::kLeftOut);
  }
  for (const ExportedVehicle& one : vehicles) {
    write_problem(xml, kProblemIds + one.id.value, vehicle, one.planned);
  }
  xml << "</commonRoad>\n";
  return xml.str();
}

LaneletMap open_ground(const std::vector<ExportedVehicle>& vehicles) {
  constexpr double kBorder_m = 0.5;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Point low_m{kFar, kFar};
  Point high_m{-kFar, -kFar};
  for (const ExportedVehicle& vehicle : vehicles) {
    for (const std::vector<State>* motion : {&vehicle.planned, &vehicle.driven}) {
      for (const State& state : *motion) {
        low_m = low_m.cwiseMin(state.pose.position_m());
        high_m = high_m.cwiseMax(state.pose.position_m());
      }
    }
  }
  low_m -= Point{kBorder_m, kBorder_m};
  high_m += Point{kBorder_m, kBorder_m};
  return {.benchmark_id = "ZAM_OpenGround-1_1_T-1",
          .lanelets = {{1,
                        {.id = 1,
                         .left_m = {{low_m.x(), high_m.y()}, high_m},
                         .right_m = {low_m, {high_m.x(), low_m.y()}},
                         .predecessors = {},
                         .successors = {},
                         .adjacent_left = {},
                         .adjacent_right = {}}}}};
}

}  // namespace hlc
