#pragma once

#include <optional>

#include "planner/automaton/automaton.hpp"
#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// Unit cost l(x, 0) of a trim (paper, Section 3): cost per second of driving it, the same at every
/// pose. Nothing for a criterion that depends on the pose.
[[nodiscard]] std::optional<double> unit_cost(const automaton::Trim& trim, const RunningCost& cost);

/// Cost of driving a trim for `duration_s` from the origin: T times the unit cost, or, for a
/// criterion that depends on the pose, the integral from the step's own start (Simpson's rule on 64
/// pieces of the exact arc).
[[nodiscard]] double trim_step_cost(const automaton::Trim& trim, double duration_s,
                                    const RunningCost& cost,
                                    const vehicle::VehicleParameters& vehicle);

}  // namespace hlc::maneuver_design
