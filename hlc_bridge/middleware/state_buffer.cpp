#include "hlc_bridge/middleware/state_buffer.hpp"

#include <algorithm>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::middleware {

void StateBuffer::add(std::uint8_t vehicle_id, const VehicleState& state) {
  PerVehicle& vehicle = vehicles_[vehicle_id];
  const auto place = std::upper_bound(
      vehicle.states.begin(), vehicle.states.end(), state.create_stamp,
      [](Nanoseconds stamp, const VehicleState& other) { return stamp < other.create_stamp; });
  vehicle.states.insert(place, state);
  if (vehicle.states.size() > kCapacity) {
    vehicle.states.erase(vehicle.states.begin());
  }
  vehicle.any = true;
  vehicle.largest_create_stamp = std::max(vehicle.largest_create_stamp, state.create_stamp);
}

bool StateBuffer::holds(std::uint8_t vehicle_id, Nanoseconds create_stamp) const {
  const auto found = vehicles_.find(vehicle_id);
  return found != vehicles_.end() && found->second.any &&
         found->second.largest_create_stamp >= create_stamp;
}

const VehicleState* StateBuffer::newest_valid(std::uint8_t vehicle_id, Nanoseconds t_now) const {
  const auto found = vehicles_.find(vehicle_id);
  if (found == vehicles_.end()) {
    return nullptr;
  }
  const std::vector<VehicleState>& states = found->second.states;
  const auto newest = std::find_if(states.rbegin(), states.rend(), [&](const VehicleState& state) {
    return state.valid_after_stamp <= t_now;
  });
  return newest == states.rend() ? nullptr : &*newest;
}

void StateBuffer::forget_before(Nanoseconds t_now) {
  for (auto& [id, vehicle] : vehicles_) {
    if (const VehicleState* newest = newest_valid(id, t_now)) {
      vehicle.states.erase(vehicle.states.begin(),
                           vehicle.states.begin() + (newest - vehicle.states.data()));
    }
  }
}

VehicleStateList compose_state_list(const StateBuffer& buffer, Nanoseconds t_now,
                                    Nanoseconds period,
                                    std::span<const std::int32_t> active_vehicle_ids) {
  VehicleStateList list;
  list.t_now = t_now;
  list.period_ms = period / kNanosecondsPerMillisecond;
  list.active_vehicle_ids.assign(active_vehicle_ids.begin(), active_vehicle_ids.end());
  list.states.reserve(active_vehicle_ids.size());
  for (const std::int32_t id : active_vehicle_ids) {
    const VehicleState* state = buffer.newest_valid(static_cast<std::uint8_t>(id), t_now);
    list.states.push_back(state != nullptr ? *state : VehicleState{});
  }
  return list;
}

}  // namespace hlc::middleware
