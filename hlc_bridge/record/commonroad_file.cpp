#include "hlc_bridge/record/commonroad_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "planner/common/demand.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/road/commonroad_writer.hpp"

namespace hlc::record {
namespace {

enum class Steering { kWritten, kLeftOut };

/// A quantity with one value.
void add_exact(road::CommonRoadWriter& xml, const char* name, double value) {
  xml.open_inline(name);
  xml.number("exact", value);
  xml.close_inline();
}

void add_place(road::CommonRoadWriter& xml, const Point& place_m) {
  xml.open_inline("position");
  xml.open_inline("point");
  xml.number("x", place_m.x());
  xml.number("y", place_m.y());
  xml.close_inline();
  xml.close_inline();
}

void add_time(road::CommonRoadWriter& xml, std::size_t time) {
  xml.open_inline("time");
  xml.text("exact", fmt::to_string(time));
  xml.close_inline();
}

/// The content of a state, in one line.
void add_state(road::CommonRoadWriter& xml, const vehicle::State& state, std::size_t time,
               Steering steering) {
  add_place(xml, state.pose.position_m());
  add_exact(xml, "orientation", wrap_angle(state.pose.heading_rad));
  add_time(xml, time);
  add_exact(xml, "velocity", state.speed_mps);
  if (steering == Steering::kWritten) add_exact(xml, "steeringAngle", state.steering_rad);
}

void add_shape(road::CommonRoadWriter& xml, const Footprint& footprint) {
  xml.open("shape");
  xml.open_inline("rectangle");
  xml.number("length", footprint.length_m);
  xml.number("width", footprint.width_m);
  xml.close_inline();
  xml.close_inline();
}

void add_motion(road::CommonRoadWriter& xml, int id, const Footprint& footprint,
                const std::vector<vehicle::State>& states, Steering steering) {
  HLC_DEMAND(states.size() >= 2, states.size());
  xml.open("dynamicObstacle");
  xml.PushAttribute("id", id);
  xml.text("type", "car", false);
  add_shape(xml, footprint);
  xml.open("initialState");
  add_state(xml, states.front(), 0, steering);
  xml.close_inline();
  xml.open("trajectory");
  for (std::size_t i = 1; i < states.size(); ++i) {
    xml.open("state");
    add_state(xml, states[i], i, steering);
    xml.close_inline();
  }
  xml.close();
  xml.close();
}

void add_obstacle(road::CommonRoadWriter& xml, int id, const ConvexPolygon& area_m) {
  Point middle_m{Point::Zero()};
  for (const Point& corner : area_m.vertices_m) middle_m += corner;
  middle_m /= static_cast<double>(area_m.vertices_m.size());
  xml.open("staticObstacle");
  xml.PushAttribute("id", id);
  xml.text("type", "unknown", false);
  xml.open("shape");
  xml.open_inline("polygon");
  for (const Point& corner : area_m.vertices_m) {
    xml.open_inline("point");
    xml.number("x", corner.x() - middle_m.x());
    xml.number("y", corner.y() - middle_m.y());
    xml.close_inline();
  }
  xml.close_inline();
  xml.close_inline();
  xml.open("initialState");
  add_place(xml, middle_m);
  add_exact(xml, "orientation", 0.0);
  add_time(xml, 0);
  xml.close_inline();
  xml.close();
}

void add_problem(road::CommonRoadWriter& xml, int id, const vehicle::VehicleParameters& vehicle,
                 const std::vector<vehicle::State>& planned) {
  const vehicle::State& start = planned.front();
  xml.open("planningProblem");
  xml.PushAttribute("id", id);
  xml.open("initialState");
  add_state(xml, start, 0, Steering::kLeftOut);
  add_exact(xml, "yawRate",
            start.speed_mps * vehicle::curvature_per_m(start.steering_rad, vehicle));
  add_exact(xml, "slipAngle", vehicle::slip_angle_rad(start.steering_rad, vehicle));
  xml.close_inline();
  xml.open("goalState");
  xml.open_inline("time");
  xml.text("intervalStart", fmt::to_string(planned.size() - 1));
  xml.text("intervalEnd", fmt::to_string(planned.size() - 1));
  xml.close_inline();
  xml.close_inline();
  xml.close();
}

void check_ids(const road::LaneletMap& map) {
  if (!map.lanelets.empty() && map.lanelets.rbegin()->first > kProblemIds) {
    throw std::runtime_error(fmt::format("{}: lanelet {}, id must be <= {}", map.benchmark_id,
                                         map.lanelets.rbegin()->first, kProblemIds));
  }
}

}  // namespace

std::string commonroad_xml(const road::LaneletMap& map, const vehicle::VehicleParameters& vehicle,
                           const std::vector<ExportedVehicle>& vehicles,
                           const std::vector<ConvexPolygon>& obstacles_m, double time_step_s) {
  check_ids(map);
  road::CommonRoadWriter xml({.benchmark_id = map.benchmark_id,
                              .author = "export_commonroad",
                              .source = "run",
                              .time_step = shortest_text(time_step_s)});
  xml.add_lanelets(map);
  for (std::size_t i = 0; i < obstacles_m.size(); ++i) {
    add_obstacle(xml, kObstacleIds + static_cast<int>(i) + 1, obstacles_m[i]);
  }
  for (const ExportedVehicle& one : vehicles) {
    add_motion(xml, kPlannedIds + one.id.value, vehicle.footprint, one.planned, Steering::kWritten);
    add_motion(xml, kDrivenIds + one.id.value, vehicle.footprint, one.driven, Steering::kLeftOut);
  }
  for (const ExportedVehicle& one : vehicles) {
    add_problem(xml, kProblemIds + one.id.value, vehicle, one.planned);
  }
  return xml.finish();
}

road::LaneletMap open_ground(const std::vector<ExportedVehicle>& vehicles,
                             const std::vector<ConvexPolygon>& obstacles_m) {
  constexpr double kBorder_m = 0.5;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Point low_m{kFar, kFar};
  Point high_m{-kFar, -kFar};
  for (const ExportedVehicle& vehicle : vehicles) {
    for (const std::vector<vehicle::State>* motion : {&vehicle.planned, &vehicle.driven}) {
      for (const vehicle::State& state : *motion) {
        low_m = low_m.cwiseMin(state.pose.position_m());
        high_m = high_m.cwiseMax(state.pose.position_m());
      }
    }
  }
  for (const ConvexPolygon& one : obstacles_m) {
    const Box box = bounding_box(one);
    low_m = low_m.cwiseMin(box.min_m);
    high_m = high_m.cwiseMax(box.max_m);
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

}  // namespace hlc::record
