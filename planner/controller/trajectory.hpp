#pragma once

#include <vector>

#include "planner/coordination/plan.hpp"

namespace hlc {

/// One timed point of a planned motion, for a vehicle that follows points.
struct TrajectorySample {
  double time_s{};  ///< from t(step)
  Point position_m{Point::Zero()};
  Eigen::Vector2d velocity_mps{Point::Zero()};
};

/// The plan as timed points, strictly increasing in time: one `interval_s` before t(step), then
/// every `interval_s` until the plan stands and until `until_s` at the least, standing at the end.
/// Velocities are the derivatives of the positions (single-track model: v in the direction heading
/// + slip).
/// @pre interval_s > 0 divides the step length
[[nodiscard]] std::vector<TrajectorySample> sample_trajectory(const Plan& plan, StepIndex step,
                                                              double interval_s, double until_s,
                                                              double step_s,
                                                              const VehicleParameters& vehicle);

}  // namespace hlc
