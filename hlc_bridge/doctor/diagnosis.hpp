#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/doctor/finding.hpp"
#include "hlc_bridge/messages/messages.hpp"

namespace hlc::doctor {

/// Received from one vehicle.
struct ReceivedVehicle {
  std::size_t states{};
  Nanoseconds first_at{};  ///< arrival of the first one
  /// Time of arrival minus create_stamp, the least of all states: the network delay plus the offset
  /// of the vehicle's clock (negative: that clock is ahead).
  std::int64_t least_age_ns{};
  bool has_logical_stamps{};  ///< its stamps are not of this century
  bool is_located{};          ///< by its last state (messages/settled_states.hpp)
};

/// Received from a run, or from a lab before a run.
struct Received {
  Nanoseconds ended_at{};                            ///< on this machine's clock
  std::map<std::uint8_t, ReceivedVehicle> vehicles;  ///< those that published anything
  bool lab_control_answers{};                        ///< a parameter request was answered
  std::optional<std::uint64_t> period_ms;            ///< as answered by the lab control
  std::set<std::string> controllers;                 ///< names on the domain of the controllers
  /// Of those that publish one (Participant::versions)
  std::map<std::string, std::string> versions;
  bool listened_to_middleware{};
  std::size_t lists{};  ///< from the middleware
  /// As ReceivedVehicle::least_age_ns, of t_now of those in real time; none: logical time
  std::optional<std::int64_t> least_list_age_ns;
};

/// Adds a vehicle's state received at `now`.
void note(const VehicleState& state, Nanoseconds now, Received& received);
/// The same for a list.
void note(const VehicleStateList& list, Nanoseconds now, Received& received);

/// Everything that a run with these vehicles needs has been received, of every vehicle for `span`
/// since its first state: discovery takes its time on a busy machine.
[[nodiscard]] bool is_complete(const std::vector<int>& vehicle_ids, const Received& received,
                               Nanoseconds now, Nanoseconds span);

/// Findings for a run with these vehicles, each with advice.
/// @param version  of this machine's programs; empty: versions are not compared
[[nodiscard]] std::vector<Finding> diagnose(const std::vector<int>& vehicle_ids,
                                            const Received& received,
                                            const std::string& version = "");

}  // namespace hlc::doctor
