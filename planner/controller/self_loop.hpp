#pragma once

#include "planner/automaton/automaton.hpp"
#include "planner/common/demand.hpp"

namespace hlc::controller {

/// The maneuver that stays in the trim for a step; every trim has one. The automaton owns it.
[[nodiscard]] inline const automaton::Maneuver& self_loop(
    const automaton::UniversalAutomaton& automaton, TrimId trim) {
  const automaton::Maneuver* maneuver = automaton.find(trim, trim, automaton::kSelfLoopLabel);
  HLC_DEMAND(maneuver != nullptr, trim.index);
  return *maneuver;
}

}  // namespace hlc::controller
