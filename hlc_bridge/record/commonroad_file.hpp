#pragma once

#include <string>
#include <vector>

#include "planner/coordination/messages.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/vehicle/single_track.hpp"

namespace hlc::record {

/// One vehicle of a run in the file's form: states at 0, 1, 2 ... time steps.
struct ExportedVehicle {
  VehicleId id;
  std::vector<vehicle::State> planned;  ///< heading of the single-track model, speed, steering
  std::vector<vehicle::State> driven;   ///< yaw, speed; steering is not written
};

/// Ids of a vehicle's elements; those of lanelets stay below.
inline constexpr int kProblemIds = 1'000'000;  ///< + vehicle id: planning problem
inline constexpr int kPlannedIds = 2'000'000;  ///< + vehicle id: what was planned
inline constexpr int kDrivenIds = 3'000'000;   ///< + vehicle id: what was driven
/// + place in the list, from 1: an obstacle
inline constexpr int kObstacleIds = 4'000'000;

/// A run as CommonRoad 2020a: the map; per obstacle a static one, a polygon around its initial
/// position, the mean of its corners; per vehicle its planned and its driven motion, a dynamic
/// obstacle each, with the vehicle's own rectangle; per vehicle a planning problem from the begin
/// of its plan, whose goal is any state at the end. Numbers with 9 decimals, angles in (-pi, pi].
///
/// The reference point is the centre of gravity. Equal runs give equal bytes.
///
/// @param time_step_s  between two states
/// @pre both motions of every vehicle have two states at least
/// @throws std::runtime_error for a lanelet id that is not below those of vehicles
[[nodiscard]] std::string commonroad_xml(const road::LaneletMap& map,
                                         const vehicle::VehicleParameters& vehicle,
                                         const std::vector<ExportedVehicle>& vehicles,
                                         const std::vector<ConvexPolygon>& obstacles_m,
                                         double time_step_s);

/// A map for a run without lanes, since the format requires one: a single lane, 0.5 m wider on all
/// sides than the area of the vehicles' reference points and of the obstacles.
[[nodiscard]] road::LaneletMap open_ground(const std::vector<ExportedVehicle>& vehicles,
                                           const std::vector<ConvexPolygon>& obstacles_m);

}  // namespace hlc::record
