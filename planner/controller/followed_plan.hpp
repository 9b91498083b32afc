#pragma once

#include "planner/controller/controller.hpp"

namespace hlc::controller {

/// State in a list of that step of a vehicle that follows its controller's plan exactly. Its yaw is
/// not the planner's heading. @pre controller.has_plan()
[[nodiscard]] coordination::MeasuredVehicle on_its_plan(const Controller& controller,
                                                        StepIndex step);

/// The same of a vehicle in that state.
[[nodiscard]] coordination::MeasuredVehicle as_measured(
    VehicleId vehicle, const vehicle::State& state, const automaton::UniversalAutomaton& automaton);

}  // namespace hlc::controller
