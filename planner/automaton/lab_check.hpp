#pragma once

#include <string>

#include "planner/automaton/subgraph.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc::automaton {

/// The first trim or maneuver of the subgraph that the lab's vehicles cannot follow (curve_fault of
/// its points every point_interval_s), with value and bound in one line; empty if they can follow
/// all.
///
/// The points of a command lie on that grid of every step, and an interval lies within one
/// maneuver. So if this function finds nothing, no plan on the subgraph has a curve_fault, wherever
/// it leads: a fault of a command is then a fault of the program or of its data.
/// @pre point_interval_s divides the step length
/// @pre point_interval_s divides the step length
[[nodiscard]] std::string validate_for_lab(const Subgraph& subgraph,
                                           const vehicle::LabLimits& limits);

}  // namespace hlc::automaton
