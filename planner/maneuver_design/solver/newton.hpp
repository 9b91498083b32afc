#pragma once

#include "planner/maneuver_design/solver/transcription.hpp"

namespace hlc::maneuver_design {

struct NewtonResult {
  Eigen::VectorXd z;
  bool converged{};  ///< the last step was negligible
};

/// Newton's method with bounds (sequential quadratic programming with second derivatives): makes
/// the last digits of a solution, and so its pose, reproducible.
///
/// Each round minimises the quadratic model of the objective under the end conditions, the bounds
/// of z and the bounds on states (all linear in z), see active_set_qp.hpp, and follows that step as
/// far as the objective decreases. Second derivatives are central differences of the exact
/// gradient. Inputs whose bound is clearly active (active_bounds.hpp) are left out of the round:
/// for J1, nearly all accelerations.
///
/// @param start  meets the end conditions and the bounds
/// @pre the duration is fixed, `constraints` names neither path constraints nor bounds on costs
[[nodiscard]] NewtonResult newton(const Transcription& transcription,
                                  const ConstraintSet& constraints, const Eigen::VectorXd& start);

}  // namespace hlc::maneuver_design
