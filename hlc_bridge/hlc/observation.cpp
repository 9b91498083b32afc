#include "hlc_bridge/hlc/observation.hpp"

#include <algorithm>

#include "hlc_bridge/messages/settled_states.hpp"
#include "planner/coordination/missing.hpp"

namespace hlc::high_level_controller {
namespace {

constexpr auto kMaxStateAge = static_cast<Nanoseconds>(1e9 * coordination::kMaxStateAge_s);
constexpr std::int32_t kMaxWireId = 255;  // more than the lab has: every active vehicle counts

}  // namespace

StepIndex step_of(const VehicleStateList& list) { return {step_at(list.t_now, period_of(list))}; }

Nanoseconds deadline_in_step(const VehicleStateList& list, double share) {
  const Nanoseconds end = (step_of(list).value + 1) * period_of(list);
  return list.t_now + static_cast<Nanoseconds>(share * static_cast<double>(end - list.t_now));
}

bool is_usable(const VehicleState& state, Nanoseconds t_now) {
  return state.vehicle_id != 0 && is_finite(state) && is_located(state) &&
         state.valid_after_stamp <= t_now && state.create_stamp <= t_now &&
         t_now - state.create_stamp <= kMaxStateAge;
}

controller::Observation observation_of(const VehicleStateList& list, double pose_lead_s) {
  controller::Observation observation{.step = step_of(list)};
  const Nanoseconds step_start = observation.step.value * period_of(list);
  for (const std::int32_t id : list.active_vehicle_ids) {
    if (id > 0 && id <= kMaxWireId) {
      observation.active.push_back({static_cast<std::uint8_t>(id)});
    }
  }
  std::ranges::sort(observation.active);
  const auto twice = std::ranges::unique(observation.active);
  observation.active.erase(twice.begin(), twice.end());
  for (const VehicleState& state : list.states) {
    if (!is_usable(state, list.t_now)) continue;
    const double age_s =
        1e-9 * static_cast<double>(static_cast<std::int64_t>(step_start - state.create_stamp));
    observation.states.push_back({.vehicle = {state.vehicle_id},
                                  .pose = state.pose,
                                  .speed_mps = state.speed_mps,
                                  .age_s = age_s,
                                  .pose_lead_s = pose_lead_s});
  }
  std::ranges::sort(observation.states, {}, &coordination::MeasuredVehicle::vehicle);
  return observation;
}

std::optional<double> battery_voltage_v(const VehicleStateList& list, VehicleId vehicle) {
  const auto own = std::ranges::find_if(list.states, [&](const VehicleState& state) {
    return state.vehicle_id == vehicle.value && is_usable(state, list.t_now);
  });
  if (own == list.states.end() || !(own->battery_voltage_v > 0.0)) return std::nullopt;
  return own->battery_voltage_v;
}

bool is_complete(const controller::Observation& observation) {
  return std::ranges::all_of(observation.active, [&](VehicleId vehicle) {
    return std::ranges::find(observation.states, vehicle,
                             &coordination::MeasuredVehicle::vehicle) != observation.states.end();
  });
}

}  // namespace hlc::high_level_controller
