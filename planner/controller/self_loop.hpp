#pragma once

#include <cassert>

#include "planner/automaton/automaton.hpp"

namespace hlc {

/// The maneuver that stays in the trim for a step; every trim has one. The automaton owns it.
[[nodiscard]] inline const Maneuver& self_loop(const UniversalAutomaton& automaton, TrimId trim) {
  const Maneuver* maneuver = automaton.find(trim, trim, kSelfLoopLabel);
  assert(maneuver != nullptr && "every trim has a self-loop");
  return *maneuver;
}

}  // namespace hlc
