#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/doctor/finding.hpp"
#include "hlc_bridge/messages/messages.hpp"

namespace hlc {

/// What was heard of one vehicle.
struct HeardVehicle {
  std::size_t states{};
  /// Time of arrival minus create_stamp, the least of all states: the way on the network, and by
  /// how much its clock is behind ours (negative: it is ahead).
  std::int64_t least_age_ns{};
  bool has_logical_stamps{};  ///< its stamps are not of this century
  bool is_located{};          ///< by its last state (messages/settled_states.hpp)
};

/// What was heard of a run, or of a lab before a run.
struct Heard {
  std::chrono::duration<double> listened_s{};
  std::map<std::uint8_t, HeardVehicle> vehicles;  ///< those that said anything
  bool lab_control_answers{};                     ///< a parameter request was answered
  std::optional<std::uint64_t> period_ms;         ///< as the lab control says
  std::set<std::string> controllers;              ///< names on the domain of the controllers
  std::map<std::string, std::string> versions;    ///< of who tells one (Participant::versions)
  bool listened_to_middleware{};
  std::size_t lists{};  ///< from the middleware
};

/// Takes note of a vehicle's state that came now.
void note(const VehicleState& state, Nanoseconds now, Heard& heard);

/// What that means for a run with these vehicles, and what to do.
/// @param version  of this machine's programs; empty: versions are not compared
[[nodiscard]] std::vector<Finding> diagnose(const std::vector<int>& vehicle_ids, const Heard& heard,
                                            const std::string& version = "");

}  // namespace hlc
