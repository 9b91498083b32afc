#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "planner/controller/controller.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"

/// Controllers of cars that shall drive east, and what state lists show of such cars.
namespace hlc::controller::east_bound {

/// Of the authors.
inline const ControllerStrategies kAgreed{.coordination = kAgreedCoordination};

inline std::shared_ptr<const automaton::Subgraph> subgraph() {
  static const auto result = std::make_shared<const automaton::Subgraph>(
      automaton::paper_automaton(), automaton::paper_configuration().subgraphs.front());
  return result;
}

/// A controller whose car shall drive east along y = `y_m`, standing at x = 0 at step 100.
inline std::unique_ptr<Controller> controller(std::uint8_t vehicle, double y_m = 0.0,
                                              const ControllerStrategies& strategies = {}) {
  return std::make_unique<Controller>(
      ControllerOptions{.vehicle = {vehicle}, .strategies = strategies}, subgraph(),
      road::ReferencePath({Point(0.0, y_m), Point(10.0, y_m)}, false), road::Corridor{});
}

inline coordination::MeasuredVehicle seen(std::uint8_t vehicle, double x_m, double y_m,
                                          double speed_mps = 0.0) {
  const double yaw = automaton::yaw_minus_heading_rad(0.0, automaton::paper_automaton()->vehicle,
                                                      automaton::paper_automaton()->identified);
  return {.vehicle = {vehicle}, .pose = {x_m, y_m, yaw}, .speed_mps = speed_mps, .age_s = 0.0};
}

inline Observation at(std::uint64_t k, std::vector<coordination::MeasuredVehicle> states) {
  Observation observation{.step = {k}, .states = std::move(states)};
  for (const coordination::MeasuredVehicle& state : observation.states)
    observation.active.push_back(state.vehicle);
  return observation;
}

/// What the planned car's vehicle shows if it follows perfectly.
inline coordination::MeasuredVehicle following(const Controller& one, std::uint64_t k) {
  const vehicle::State state =
      one.plan_in_force().state_at({k}, 0.0, automaton::paper_automaton()->vehicle);
  coordination::MeasuredVehicle result =
      seen(one.options().vehicle.value, state.pose.x_m, state.pose.y_m);
  result.speed_mps = state.speed_mps;
  return result;
}

}  // namespace hlc::controller::east_bound
