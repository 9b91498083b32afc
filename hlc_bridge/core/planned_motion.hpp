#pragma once

#include <span>
#include <vector>

#include "hlc_bridge/core/run_record.hpp"

/// What a vehicle was planned to do between the steps: the reports tell pose and trim at every
/// t(k), the automaton knows the motion between two trims.
namespace hlc {

/// The maneuver planned for the step of `row`: of the edges between the two trims, the one that
/// leads nearest to the next planned pose; if none leads there, one of the whole automaton that
/// does: the vehicle planned on another subgraph then. nullptr if the reports do not say, or if it
/// must have been a maneuver that the automaton does not hold, of new weights (weight_design.hpp).
/// @param next       the vehicle's next row; nullptr: none
/// @param automaton  the scenario's subgraph
[[nodiscard]] const Maneuver* maneuver_during(const StepRecord& row, const StepRecord* next,
                                              const Subgraph& automaton);

/// The planned states of one vehicle every `interval`, from t(0) of the run to the time of its last
/// row. At t(k) that is what was reported; in between, the motion that ends where the plan is at
/// t(k + 1). So a plan that its controller sets down anew in step k, where the car really is
/// (planner/controller/plan_in_force.hpp), shows as a jump just after t(k), when it comes into
/// force.
///
/// @param rows  of that vehicle, by step
/// @pre `interval` divides `period`
/// @throws std::runtime_error naming vehicle and step where a row is missing or two rows fit no
/// maneuver
[[nodiscard]] std::vector<State> planned_motion(std::span<const StepRecord* const> rows,
                                                Nanoseconds period, Nanoseconds interval,
                                                const Subgraph& automaton);

/// What was driven at the same times: true pose (heading_rad is the yaw) and speed, steering 0.
/// Between two ticks the simulated car's motion is linear.
///
/// @param count  states; fewer are returned if the drive ends before
[[nodiscard]] std::vector<State> driven_motion(std::span<const DrivenSample> drive,
                                               Nanoseconds begin, Nanoseconds interval,
                                               std::size_t count);

}  // namespace hlc
