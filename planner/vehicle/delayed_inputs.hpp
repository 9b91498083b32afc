#pragma once

#include <algorithm>
#include <array>

#include "planner/vehicle/identified_motion.hpp"

namespace hlc::vehicle {

/// The inputs of a vehicle that are on their way to its actuators: one given at tick n acts from
/// tick n + 4 to n + 5 (`kInputDelayTicks`).
///
/// A value: copies are independent.
class DelayedInputs {
 public:
  /// Before the fifth input the actuators have `resting`.
  explicit DelayedInputs(const ActuatorInput& resting = {}) { under_way_.fill(resting); }

  /// Queues what the actuators make of `wanted`, once per tick.
  /// @param wanted  finite
  /// @return the input that acts from this tick to the next
  ActuatorInput give(const ActuatorInput& wanted, const IdentifiedVehicle& vehicle) {
    const ActuatorInput acting = under_way_.front();
    const ActuatorInput last = under_way_.back();
    std::shift_left(under_way_.begin(), under_way_.end(), 1);
    under_way_.back() = actuated(wanted, last, vehicle);
    return acting;
  }

  /// Oldest first: the first one acts from the coming tick on.
  [[nodiscard]] const std::array<ActuatorInput, kInputDelayTicks>& under_way() const {
    return under_way_;
  }
  /// The one given last.
  [[nodiscard]] const ActuatorInput& last() const { return under_way_.back(); }

 private:
  std::array<ActuatorInput, kInputDelayTicks> under_way_{};  ///< oldest first
};

}  // namespace hlc::vehicle
