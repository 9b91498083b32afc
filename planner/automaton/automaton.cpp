#include "planner/automaton/automaton.hpp"

#include <algorithm>
#include <cmath>

#include "planner/common/demand.hpp"

namespace hlc::automaton {

const Maneuver* UniversalAutomaton::find(TrimId from, TrimId to, const std::string& label) const {
  const Maneuver* self_loop = nullptr;
  for (const Maneuver& m : maneuvers) {
    if (m.from != from || m.to != to) continue;
    if (m.label == label) return &m;
    if (m.is_self_loop()) self_loop = &m;
  }
  return self_loop;
}

double top_speed_mps(const Maneuver& maneuver) {
  double largest_mps = 0.0;
  for (const vehicle::State& state : maneuver.states)
    largest_mps = std::max(largest_mps, state.speed_mps);
  return largest_mps;
}

double top_speed_mps(const UniversalAutomaton& automaton) {
  double largest_mps = 0.0;
  for (const Maneuver& maneuver : automaton.maneuvers) {
    largest_mps = std::max(largest_mps, top_speed_mps(maneuver));
  }
  return largest_mps;
}

double yaw_minus_heading_rad(double steering_rad, const vehicle::VehicleParameters& vehicle,
                             const vehicle::IdentifiedVehicle& identified) {
  return vehicle::slip_angle_rad(steering_rad, vehicle) -
         vehicle::steady_slip_rad(vehicle::curvature_per_m(steering_rad, vehicle), identified);
}

bool is_at_steering_limit(const Trim& trim, const vehicle::VehicleParameters& vehicle,
                          const vehicle::IdentifiedVehicle& identified) {
  constexpr double kUsable = 0.80;
  const double servo =
      vehicle::steady_servo(vehicle::curvature_per_m(trim.steering_rad, vehicle), identified);
  return std::abs(servo) > kUsable;
}

vehicle::State state_at(const Maneuver& maneuver, double time_s,
                        const vehicle::VehicleParameters& vehicle) {
  HLC_DEMAND(!maneuver.inputs.empty() && maneuver.states.size() == maneuver.inputs.size() + 1,
             maneuver.inputs.size(), maneuver.states.size());
  const double time = std::clamp(time_s, 0.0, maneuver.duration_s);
  if (maneuver.is_self_loop()) {
    vehicle::State state = maneuver.states.front();
    state.pose =
        vehicle::trim_motion(state.pose, state.speed_mps, state.steering_rad, time, vehicle);
    return state;
  }
  const std::size_t intervals = maneuver.inputs.size();
  const double interval_s = maneuver.duration_s / static_cast<double>(intervals);
  // Times are sums of ticks: at the end of an interval (to within their rounding) the state is
  // known.
  constexpr double kSameInstant_s = 1e-12;
  const auto knot = static_cast<std::size_t>(std::lround(time / interval_s));
  if (std::abs(time - static_cast<double>(knot) * interval_s) < kSameInstant_s) {
    return maneuver.states[knot];
  }
  const std::size_t interval = std::min(static_cast<std::size_t>(time / interval_s), intervals - 1);
  const double rest_s = time - static_cast<double>(interval) * interval_s;
  return vehicle::integrated(maneuver.states[interval], maneuver.inputs[interval], rest_s, vehicle);
}

}  // namespace hlc::automaton
