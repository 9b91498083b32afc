#pragma once

#include <cstdint>
#include <set>
#include <variant>
#include <vector>

#include "hlc_bridge/machine/log_line.hpp"
#include "hlc_bridge/machine/machine.hpp"
#include "hlc_bridge/messages/messages.hpp"

/// Events and actions of a middleware's machine.
namespace hlc::middleware {

using VehicleCommand =
    std::variant<TrajectoryCommand, PathTrackingCommand, SpeedCurvatureCommand, DirectCommand>;

/// A state from a vehicle's topic. The topic determines the vehicle, not the state.
struct PublishedState {
  std::uint8_t vehicle_id{};
  VehicleState state;
};

/// An observation from a vehicle's topic.
struct PublishedObservation {
  std::uint8_t vehicle_id{};
  VehicleObservation observation;
};

/// Current presence.
struct MiddlewarePeers {
  bool lab_control_is_matched{};   ///< receives the ready status, and sends triggers
  bool lab_control_is_lost{};      ///< was present and is no longer
  bool controllers_are_matched{};  ///< receive lists and triggers, and send commands and readiness
  bool commands_are_sent{};        ///< at least one controller is matched that sends commands
  std::set<std::uint8_t> own_controllers;      ///< by vehicle: present, and ours (node_names.hpp)
  std::set<std::uint8_t> lost_controllers;     ///< by vehicle: were present and are no longer
  std::set<std::uint8_t> state_publishers;     ///< vehicles whose states would be received
  std::set<std::uint8_t> command_subscribers;  ///< vehicles that would receive commands
};

/// Also receive states (and observations, where lists hold them) of these vehicles.
struct SubscribeToVehicles {
  std::vector<std::int32_t> vehicle_ids;
};

/// Messages from the lab control, the vehicles, the controllers.
using MiddlewareEvent =
    std::variant<machine::StopSignal, MiddlewarePeers, Parameter, SystemTrigger, GoalState,
                 PublishedState, PublishedObservation, ReadyStatus, VehicleCommand>;

/// To the controllers: lists, triggers, goals. To the vehicles: commands. To the lab control: the
/// ready status and requests.
using MiddlewareAction =
    std::variant<machine::LogLine, SubscribeToVehicles, VehicleStateList, SystemTrigger, GoalState,
                 VehicleCommand, ReadyStatus, ParameterRequest>;
using MiddlewareActions = std::vector<MiddlewareAction>;

}  // namespace hlc::middleware
