#pragma once

#include "planner/controller/controller.hpp"

namespace hlc {

/// State in a list of that step of a vehicle that follows its controller's plan exactly. Its yaw is
/// not the planner's heading. @pre controller.has_plan()
[[nodiscard]] MeasuredVehicle on_its_plan(const Controller& controller, StepIndex step);

/// The same of a vehicle in that state.
[[nodiscard]] MeasuredVehicle as_measured(VehicleId vehicle, const State& state,
                                          const UniversalAutomaton& automaton);

}  // namespace hlc
