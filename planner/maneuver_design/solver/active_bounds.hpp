#pragma once

#include <vector>

#include "planner/maneuver_design/solver/transcription.hpp"

namespace hlc::maneuver_design {

/// Variables that may have to move to lower the objective: all except those whose bound is active,
/// that is, those at a bound with a multiplier that clearly has the sign to keep them there. In
/// order.
///
/// The multiplier of a channel's end condition is estimated from its variables between their bounds
/// (or, without any, chosen so that the bounds can hold). A channel whose bounds on states are
/// among the constraints and reached is left free altogether.
///
/// @param gradient  of the objective at z
[[nodiscard]] std::vector<Eigen::Index> free_variables(const Transcription& transcription,
                                                       const ConstraintSet& constraints,
                                                       const Eigen::VectorXd& z,
                                                       const Eigen::VectorXd& gradient);

}  // namespace hlc::maneuver_design
