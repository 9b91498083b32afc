#pragma once

#include <span>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"

/// The planned motion of a vehicle between the steps: the reports give pose and trim at every t(k)
/// and the maneuver under way, the automaton its motion.
namespace hlc::result {

/// The maneuver under way in the step of `row`: of that label, from its trim to that of the next
/// row. A plan that is re-anchored meanwhile leads elsewhere with the same maneuvers.
///
/// nullptr if there is no next row, if the row has no plan, or if the automaton does not hold the
/// maneuver: one of new weights (weight_design.hpp).
/// @param next  the vehicle's next row; nullptr: none
[[nodiscard]] const automaton::Maneuver* maneuver_during(
    const StepRecord& row, const StepRecord* next, const automaton::UniversalAutomaton& automaton);

/// The maneuvers of the report's plan, from t(k) on, as far as the automaton holds them: plans on
/// new weights (weight_design.hpp) have others.
[[nodiscard]] std::vector<const automaton::Maneuver*> planned_maneuvers(
    const coordination::Report& report, const automaton::UniversalAutomaton& automaton);

/// The planned states of one vehicle every `interval`, from t(0) of the run to the time of its last
/// row. At t(k) that is the reported state; in between, the motion that ends where the plan is at
/// t(k + 1). So a plan that its controller re-anchors in step k at the car's real pose
/// (planner/controller/plan_in_force.hpp) shows as a jump just after t(k), when it comes into
/// force.
///
/// @param rows  of that vehicle, by step
/// @pre `interval` divides `period`
/// @throws std::runtime_error naming vehicle and step if a row is missing, or its maneuver is not
/// in the automaton
[[nodiscard]] std::vector<vehicle::State> planned_motion(
    std::span<const StepRecord* const> rows, Nanoseconds period, Nanoseconds interval,
    const automaton::UniversalAutomaton& automaton);

/// The driven states at the same times: true pose (heading_rad is the yaw) and speed, steering 0.
/// Between two ticks the simulated car's motion is linear.
///
/// @param count  states; fewer are returned if the drive ends before
[[nodiscard]] std::vector<vehicle::State> driven_motion(std::span<const DrivenSample> drive,
                                                        Nanoseconds begin, Nanoseconds interval,
                                                        std::size_t count);

}  // namespace hlc::result
