#pragma once

#include <algorithm>
#include <vector>

#include "planner/coordination/messages.hpp"
#include "planner/coordination/missing.hpp"

namespace hlc {

/// What a state list tells a controller at step k.
struct Observation {
  StepIndex step;                       ///< k
  std::vector<VehicleId> active;        ///< vehicles that take part, this one included
  std::vector<MeasuredVehicle> states;  ///< of the vehicles that have a usable one
  /// Vehicles whose controller's process is still there, received or not (see missing.hpp).
  std::vector<VehicleId> present;

  /// nullptr: it has no usable state.
  [[nodiscard]] const MeasuredVehicle* measured(VehicleId vehicle) const {
    const auto found = std::ranges::find(states, vehicle, &MeasuredVehicle::vehicle);
    return found == states.end() ? nullptr : &*found;
  }
};

}  // namespace hlc
