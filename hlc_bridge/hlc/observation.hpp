#pragma once

#include <optional>

#include "hlc_bridge/messages/time_grid.hpp"
#include "planner/controller/controller.hpp"

namespace hlc::high_level_controller {

[[nodiscard]] inline Nanoseconds period_of(const VehicleStateList& list) {
  return list.period_ms * kNanosecondsPerMillisecond;
}

/// Number of the control step that a list belongs to: k = t_now / period. @pre list.period_ms > 0
[[nodiscard]] StepIndex step_of(const VehicleStateList& list);

/// The instant at which `share` of the time from the list's t_now to the end of its step has
/// passed: lists may come late in the period (middleware's --offset_nanoseconds). @pre
/// list.period_ms > 0
[[nodiscard]] Nanoseconds deadline_in_step(const VehicleStateList& list, double share);

/// A state that may be used at t_now: of a vehicle (placeholders have id 0), finite, located
/// (settled_states.hpp), already valid, and not older than kMaxStateAge_s.
[[nodiscard]] bool is_usable(const VehicleState& state, Nanoseconds t_now);

/// The list as an observation of the controller: usable states only, with their age at t(k) and the
/// lead of their poses (LabLimits). Vehicle ids out of range are left out.
[[nodiscard]] controller::Observation observation_of(const VehicleStateList& list,
                                                     double pose_lead_s);

/// The vehicle's battery voltage from its usable state in the list; none if there is none (a
/// vehicle without a measurement publishes 0).
[[nodiscard]] std::optional<double> battery_voltage_v(const VehicleStateList& list,
                                                      VehicleId vehicle);

/// True if every active vehicle has a usable state in the list.
[[nodiscard]] bool is_complete(const controller::Observation& observation);

}  // namespace hlc::high_level_controller
