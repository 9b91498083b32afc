#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "vehicle_sim/vehicle/vehicle_machine.hpp"

namespace hlc::simulated_vehicle {

/// One vehicle's event or action.
template <class What>
struct OfVehicle {
  std::uint8_t vehicle_id{};
  What what;
};

/// By vehicle.
using FleetPresence = std::map<std::uint8_t, VehiclePresence>;

/// The simulated vehicles of one process (machine/machine.hpp), which have its time and its
/// endpoint for ticks in common: a tick is requested when no vehicle is busy with an earlier one.
///
/// Ends when all vehicles have ended, or with the first one that fails.
class VehicleFleet {
 public:
  /// Commands are of one vehicle, all other messages for every vehicle.
  using Event = std::variant<OfVehicle<VehicleMachine::Event>, Parameter, SystemTrigger,
                             FleetPresence, machine::StopSignal>;
  /// Equal requests for a parameter count once.
  using Action = std::variant<OfVehicle<VehicleMachine::Action>, ParameterRequest>;

  /// @param vehicles  at least one, each id once
  /// @throws std::invalid_argument as VehicleMachine
  explicit VehicleFleet(const std::vector<VehicleMachineOptions>& vehicles);

  void on(Event event);
  [[nodiscard]] std::vector<Action> advance(const Instant& now);
  [[nodiscard]] WakeUp wake_up() const;
  [[nodiscard]] std::size_t awaited() const;
  [[nodiscard]] std::optional<int> exit_code() const;

 private:
  void take(OfVehicle<VehicleMachine::Event>& event) {
    vehicles_.at(event.vehicle_id).on(std::move(event.what));
  }
  void take(FleetPresence& presence);
  template <class ForAll>
  void take(const ForAll& message) {
    for (auto& [id, vehicle] : vehicles_) vehicle.on(message);
  }

  std::map<std::uint8_t, VehicleMachine> vehicles_;
};

}  // namespace hlc::simulated_vehicle
