#include "planner/controller/followed_plan.hpp"

namespace hlc::controller {

coordination::MeasuredVehicle as_measured(VehicleId vehicle, const vehicle::State& state,
                                          const automaton::UniversalAutomaton& automaton) {
  coordination::MeasuredVehicle result{
      .vehicle = vehicle, .pose = state.pose, .speed_mps = state.speed_mps, .age_s = 0.0};
  result.pose.heading_rad +=
      automaton::yaw_minus_heading_rad(state.steering_rad, automaton.vehicle, automaton.identified);
  return result;
}

coordination::MeasuredVehicle on_its_plan(const Controller& controller, StepIndex step) {
  const automaton::UniversalAutomaton& automaton = controller.subgraph().automaton();
  return as_measured(controller.options().vehicle,
                     controller.plan_in_force().state_at(step, 0.0, automaton.vehicle), automaton);
}

}  // namespace hlc::controller
