#pragma once

#include <vector>

#include "planner/coordination/plan.hpp"
#include "planner/geometry/timed_curve.hpp"

namespace hlc::controller {

/// Time between the points of a command unless a lab sets it (LabLimits::point_interval_s).
inline constexpr double kPointInterval_s = 0.05;

/// The plan as timed points, strictly increasing in time: one `interval_s` before t(step), then
/// every `interval_s` until the plan stands and until `until_s` at the least, standing at the end.
/// Velocities are the derivatives of the positions (single-track model: v in the direction heading
/// + slip).
/// @pre interval_s > 0 divides the step length
[[nodiscard]] std::vector<TimedPoint> sample_trajectory(const coordination::Plan& plan,
                                                        StepIndex step, double interval_s,
                                                        double until_s, double step_s,
                                                        const vehicle::VehicleParameters& vehicle);

}  // namespace hlc::controller
