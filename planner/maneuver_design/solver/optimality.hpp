#pragma once

#include "planner/maneuver_design/solver/transcription.hpp"

namespace hlc::maneuver_design {

/// First-order residual (see first_order.hpp) at a point that meets the constraints. Bounds and
/// inequalities count as active within 1e-6 of their size.
///
/// @param gradient  of the objective or of the cost, at z
[[nodiscard]] double first_order_residual_at(const Transcription& transcription,
                                             const Eigen::VectorXd& z,
                                             const Eigen::VectorXd& gradient);

}  // namespace hlc::maneuver_design
