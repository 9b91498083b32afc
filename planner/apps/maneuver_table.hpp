#pragma once

#include <string>

#include "planner/automaton/automaton.hpp"

namespace hlc::apps {

/// CSV, one row per edge between different trims and label, in the automaton's order:
///
///     from,to,criterion,intervals,J1,J2,dx,dy,dpsi,v_max,status
///
/// Trims from 1; `criterion` is the label; J1 and J2 are the values of these criteria, whatever the
/// label; (dx, dy, dpsi) the displacement [m, m, rad]; v_max the largest speed along the maneuver
/// [m/s]; status always `optimal`, because no other maneuver is built. Numbers read back to the
/// same bits. A label with a comma or quote is quoted as usual in CSV.
[[nodiscard]] std::string maneuver_table(const automaton::UniversalAutomaton& automaton);

}  // namespace hlc::apps
