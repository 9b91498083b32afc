#pragma once

#include <algorithm>
#include <vector>

#include "planner/coordination/messages.hpp"
#include "planner/coordination/missing.hpp"

namespace hlc::controller {

/// The state list of step k, as used by a controller.
struct Observation {
  StepIndex step;                 ///< k
  std::vector<VehicleId> active;  ///< vehicles that take part, this one included
  std::vector<coordination::MeasuredVehicle> states;  ///< of the vehicles with a usable one
  /// Vehicles whose controller's process is present, received or not (see missing.hpp).
  std::vector<VehicleId> present;

  /// nullptr: no usable state.
  [[nodiscard]] const coordination::MeasuredVehicle* measured(VehicleId vehicle) const {
    const auto found = std::ranges::find(states, vehicle, &coordination::MeasuredVehicle::vehicle);
    return found == states.end() ? nullptr : &*found;
  }
};

}  // namespace hlc::controller
