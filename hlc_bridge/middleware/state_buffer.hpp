#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::middleware {

/// The states that a middleware has received from each vehicle, as long as they are needed.
///
/// A state is *valid* at t_now if valid_after_stamp <= t_now; the newest is the one with the
/// largest create_stamp, the later arrival among equals (wire contract, 6.1). Arrival order does
/// not matter. Plain data: no clock, no lock.
class StateBuffer {
 public:
  /// Most states kept per vehicle; the oldest are dropped (the lab's readers keep as many).
  static constexpr std::size_t kCapacity = 2000;

  /// @param vehicle_id  the vehicle of the topic
  void add(std::uint8_t vehicle_id, const VehicleState& state);

  /// True if a state with create_stamp >= `create_stamp` has arrived from the vehicle.
  [[nodiscard]] bool holds(std::uint8_t vehicle_id, Nanoseconds create_stamp) const;

  /// nullptr if nothing of this vehicle is valid yet.
  [[nodiscard]] const VehicleState* newest_valid(std::uint8_t vehicle_id, Nanoseconds t_now) const;

  /// Drops every state that is older than the newest valid one at `t_now`.
  void forget_before(Nanoseconds t_now);

 private:
  struct PerVehicle {
    std::vector<VehicleState> states;  ///< by create_stamp, equal stamps in order of arrival
    bool any{};
    Nanoseconds largest_create_stamp{};
  };
  std::map<std::uint8_t, PerVehicle> vehicles_;
};

/// The list of time `t_now`: the newest valid state of every active vehicle, in the order of
/// `active_vehicle_ids`. A vehicle without any valid state is present as a default-constructed
/// state (vehicle_id 0): the reader must skip it, not take it for a vehicle at the origin (wire
/// contract, trap 5). Observations are left empty: the states already contain the vehicles' own
/// estimate, and our controller needs no other.
[[nodiscard]] VehicleStateList compose_state_list(const StateBuffer& buffer, Nanoseconds t_now,
                                                  Nanoseconds period,
                                                  std::span<const std::int32_t> active_vehicle_ids);

}  // namespace hlc::middleware
