#pragma once

#include <vector>

#include "planner/controller/ended_step.hpp"

/// Which vehicles a standing vehicle waits for: the only place that decides on it. It explains a
/// step that is over, and changes no plan.
namespace hlc::controller {

/// Whether the vehicle keeps the pose from t(first) to t(last).
[[nodiscard]] bool stays_at(const coordination::Plan& plan, const Pose& pose, StepIndex first,
                            StepIndex last);

/// The vehicle waits if
///
/// 1. it planned, or kept its plan for a reason that others can cause: `infeasible`, `missing`,
///    `conflict`, `neighbour`. Not if it is disturbed, late or off its route, if its plan cannot be
///    driven or if its search used up its budget;
/// 2. its plan in force stands: the same pose from t(k) to t(k+1+horizon);
/// 3. alone it would move: its optimum without all others leads away from where it begins. At its
///    goal, or where the boundary of its lanes leaves no way, it stands but does not wait;
/// 4. there is a vehicle that stops that motion: one whose areas meet those of the motion alone,
///    or that prevents any motion.
///
/// @return the vehicles of 4, by the first step in which they stop the motion, then by id; empty if
/// the vehicle does not wait
[[nodiscard]] std::vector<VehicleId> waits_for(const EndedStep& step);

}  // namespace hlc::controller
