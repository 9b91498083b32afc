#pragma once

#include "planner/automaton/automaton.hpp"
#include "planner/common/demand.hpp"

namespace hlc {

/// The maneuver that stays in the trim for a step; every trim has one. The automaton owns it.
[[nodiscard]] inline const Maneuver& self_loop(const UniversalAutomaton& automaton, TrimId trim) {
  const Maneuver* maneuver = automaton.find(trim, trim, kSelfLoopLabel);
  HLC_DEMAND(maneuver != nullptr, trim.index);
  return *maneuver;
}

}  // namespace hlc
