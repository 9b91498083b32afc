#include "planner/controller/followed_plan.hpp"

namespace hlc {

MeasuredVehicle as_measured(VehicleId vehicle, const State& state,
                            const UniversalAutomaton& automaton) {
  MeasuredVehicle result{
      .vehicle = vehicle, .pose = state.pose, .speed_mps = state.speed_mps, .age_s = 0.0};
  result.pose.heading_rad +=
      yaw_minus_heading_rad(state.steering_rad, automaton.vehicle, automaton.identified);
  return result;
}

MeasuredVehicle on_its_plan(const Controller& controller, StepIndex step) {
  const UniversalAutomaton& automaton = controller.subgraph().automaton();
  return as_measured(controller.options().vehicle,
                     controller.plan_in_force().state_at(step, 0.0, automaton.vehicle), automaton);
}

}  // namespace hlc
