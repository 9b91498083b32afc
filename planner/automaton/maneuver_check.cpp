#include "planner/automaton/maneuver_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/common/yaml_text.hpp"
#include "planner/geometry/footprint.hpp"
#include "planner/vehicle/lateral_acceleration.hpp"
#include "planner/vehicle/path_curvature.hpp"

namespace hlc::automaton {
namespace {

constexpr double kSame = 1e-9;

bool is_bounded(double value, double min, double max) {
  const double slack = kSame * std::max({1.0, std::abs(min), std::abs(max)});
  return value >= min - slack && value <= max + slack;
}

bool is_trim(const vehicle::State& state, const Trim& trim, const vehicle::VehicleLimits& limits) {
  return std::abs(state.speed_mps - trim.speed_mps) <=
             kSame * std::max(1.0, limits.speed_max_mps) &&
         std::abs(state.steering_rad - trim.steering_rad) <= kSame;
}

double distance(const Pose& a, const Pose& b) {
  return std::max((a.position_m() - b.position_m()).norm(),
                  std::abs(a.heading_rad - b.heading_rad));
}

std::string validate_ends(const Maneuver& m, const UniversalAutomaton& automaton) {
  if (m.duration_s != automaton.step_s) return "duration must be the step";
  if (m.inputs.empty() || m.states.size() != m.inputs.size() + 1) {
    return fmt::format("{} inputs and {} states, not one state more than inputs", m.inputs.size(),
                       m.states.size());
  }
  if (m.states.front().pose != Pose{}) return "begin must be the origin";
  if (!is_trim(m.states.front(), automaton.trims[m.from.index], automaton.limits)) {
    return "begin must be its trim";
  }
  if (!is_trim(m.states.back(), automaton.trims[m.to.index], automaton.limits))
    return "end must be its trim";
  if (m.displacement != m.states.back().pose) return "displacement must be the last pose";
  return "";
}

std::string validate_bounds(const Maneuver& m, const UniversalAutomaton& automaton) {
  const vehicle::VehicleLimits& limits = automaton.limits;
  for (const vehicle::Input& u : m.inputs) {
    if (!is_bounded(u.acceleration_mps2, -limits.acceleration_mps2, limits.acceleration_mps2)) {
      return "acceleration = " + shortest_text(u.acceleration_mps2) + " m/s^2, exceeds the limit";
    }
    if (!is_bounded(u.steering_rate_radps, -limits.steering_rate_radps,
                    limits.steering_rate_radps)) {
      return "steering rate = " + shortest_text(u.steering_rate_radps) +
             " rad/s, exceeds the limit";
    }
  }
  for (const vehicle::State& x : m.states) {
    if (!is_bounded(x.speed_mps, limits.speed_min_mps, limits.speed_max_mps)) {
      return "speed = " + shortest_text(x.speed_mps) + " m/s, outside the limits";
    }
    if (!is_bounded(x.steering_rad, -limits.steering_max_rad, limits.steering_max_rad)) {
      return "steering angle = " + shortest_text(x.steering_rad) + " rad, outside the limits";
    }
  }
  for (std::size_t k = 0; k < m.inputs.size(); ++k) {
    if (!vehicle::is_within_friction(m.states[k], m.inputs[k], automaton.vehicle, limits) ||
        !vehicle::is_within_friction(m.states[k + 1], m.inputs[k], automaton.vehicle, limits)) {
      return fmt::format("friction circle exceeded in interval {}", k + 1);
    }
    if (!vehicle::is_within_curvature(m.states[k], m.inputs[k], automaton.vehicle, limits) ||
        !vehicle::is_within_curvature(m.states[k + 1], m.inputs[k], automaton.vehicle, limits)) {
      return fmt::format("curvature limit exceeded in interval {}", k + 1);
    }
  }
  return "";
}

/// State k integrated over one interval.
vehicle::State integrated_again(const Maneuver& m, std::size_t k,
                                const vehicle::VehicleParameters& vehicle) {
  constexpr int kFiner = 10;
  const double interval_s = m.duration_s / static_cast<double>(m.inputs.size());
  if (m.is_self_loop()) {
    vehicle::State state = m.states[k];
    state.pose =
        vehicle::trim_motion(state.pose, state.speed_mps, state.steering_rad, interval_s, vehicle);
    return state;
  }
  vehicle::State state = m.states[k];
  for (int i = 0; i < kFiner; ++i) {
    state = vehicle::integrated(state, m.inputs[k], interval_s / kFiner, vehicle);
  }
  return state;
}

std::string validate_motion(const Maneuver& m, const vehicle::VehicleParameters& vehicle) {
  const double tolerance =
      (m.is_self_loop() ? kSame : 1e-6) *
      std::max(1.0, top_speed_mps(m) * m.duration_s / static_cast<double>(m.inputs.size()));
  for (std::size_t k = 0; k < m.inputs.size(); ++k) {
    const vehicle::State reached = integrated_again(m, k, vehicle);
    const vehicle::State& stored = m.states[k + 1];
    const bool is_same = std::abs(reached.speed_mps - stored.speed_mps) <= tolerance &&
                         std::abs(reached.steering_rad - stored.steering_rad) <= tolerance;
    // Negated, so that a NaN is a fault.
    if (!(is_same && distance(reached.pose, stored.pose) <= tolerance)) {
      return fmt::format("integrated again, does not meet state {}", k + 2);
    }
  }
  return "";
}

bool contains_footprint(const ConvexPolygon& area_m, const Pose& pose, double margin_m,
                        const vehicle::VehicleParameters& vehicle) {
  const ConvexPolygon footprint = footprint_area(vehicle.footprint, pose, margin_m);
  return !area_m.empty() &&
         std::ranges::all_of(footprint.vertices_m, [&area_m](const Point& corner) {
           return contains(area_m, corner, kSame);
         });
}

std::string validate_areas(const Maneuver& m, const UniversalAutomaton& automaton) {
  const vehicle::VehicleParameters& vehicle = automaton.vehicle;
  const std::size_t halves = 2 * m.inputs.size();
  for (std::size_t i = 0; i <= halves; ++i) {
    const double time_s = m.duration_s * static_cast<double>(i) / static_cast<double>(halves);
    const vehicle::State state = state_at(m, time_s, vehicle);
    Pose driven = state.pose;
    driven.heading_rad += yaw_minus_heading_rad(state.steering_rad, vehicle, automaton.identified);
    const double margin_m = vehicle.safety_margin_m;
    if (!contains_footprint(m.swept_area_m, state.pose, margin_m, vehicle) ||
        !contains_footprint(m.swept_area_m, driven, margin_m, vehicle)) {
      return "swept area does not contain the footprint at " + shortest_text(time_s) + " s";
    }
    if (!contains_footprint(m.lane_area_m, state.pose, 0.0, vehicle)) {
      return "lane area does not contain the footprint at " + shortest_text(time_s) + " s";
    }
  }
  return "";
}

}  // namespace

std::string validate(const Maneuver& maneuver, const UniversalAutomaton& automaton) {
  std::string fault = validate_ends(maneuver, automaton);
  if (fault.empty()) fault = validate_bounds(maneuver, automaton);
  if (fault.empty()) fault = validate_motion(maneuver, automaton.vehicle);
  if (fault.empty()) fault = validate_areas(maneuver, automaton);
  return fault;
}

}  // namespace hlc::automaton
