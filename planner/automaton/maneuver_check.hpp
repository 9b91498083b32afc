#pragma once

#include <string>

#include "planner/automaton/automaton.hpp"

namespace hlc::automaton {

/// Error of a maneuver of that automaton (its vehicle, limits, trims, step length), in words;
/// empty: none. The maneuver must
///
/// * last one step, have N inputs and N + 1 states, begin at the origin in the trim that it comes
///   from and end in the trim that it goes to (1e-9 m/s, or of the largest speed if that is more
///   than 1; 1e-9 rad), its displacement being its last pose;
/// * respect the bounds on inputs and states (1e-9, relative to the bound if that is more than 1)
///   and, at both ends of each interval, the friction circle and the limit on the curvature (1e-6);
/// * obey the model: integrated again from each state with ten times finer steps, it meets the next
///   state to 1e-6 (of position in m and heading in rad, relative to the covered distance or angle
///   if that is more than 1); a trim's self-loop follows the exact arc to 1e-9;
/// * have areas that contain the footprint at every state and midway between two (1e-9 m): the
///   swept area with margin for planned heading and driven yaw, the lane area without.
[[nodiscard]] std::string validate(const Maneuver& maneuver, const UniversalAutomaton& automaton);

}  // namespace hlc::automaton
