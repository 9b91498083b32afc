#pragma once

#include <vector>

#include "planner/maneuver_design/solver/transcription.hpp"

namespace hlc {

/// Variables that may have to move to lower the objective: all but those that lie at a bound and
/// whose multiplier clearly holds them there. In order.
///
/// The multiplier of a channel's end condition is estimated from its variables between their bounds
/// (or, without any, chosen so that the bounds can hold). A channel whose bounds on states are told
/// and reached is left open altogether.
///
/// @param gradient  of the objective at z
[[nodiscard]] std::vector<Eigen::Index> open_variables(const Transcription& transcription,
                                                       const Told& told, const Eigen::VectorXd& z,
                                                       const Eigen::VectorXd& gradient);

}  // namespace hlc
