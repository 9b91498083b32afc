#pragma once

#include "planner/coordination/plan.hpp"

namespace hlc::controller {

/// Whether a vehicle that stands would set off later with the candidate than with the plan in
/// force, or not at all.
///
/// With the distance from the reference as its cost a plan may be optimal that stands first and
/// sets off later, since an error across the path costs the less the later it is made. In the next
/// step the problem is the same and so is its solution, and so on: the vehicle would never set off.
/// So with right of way the plan in force is kept instead, and sets off when it was going to.
/// @param next  from t(next) on the candidate would be driven
/// @pre in_force is known from t(next - 1) on
[[nodiscard]] bool puts_off(const coordination::Plan& candidate, const coordination::Plan& in_force,
                            StepIndex next);

}  // namespace hlc::controller
