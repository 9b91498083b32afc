#pragma once

#include <memory>

#include "planner/automaton/automaton.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"

namespace hlc {

/// Builds the universal automaton: every trim's own step (exact arc, label "trim"), and for each
/// criterion, with the criterion's name as label, the optimal maneuver of every edge between
/// different trims that a declared subgraph needs. Order of the maneuvers: own steps by trim, then
/// by criterion as listed, from, to.
///
/// The same configuration gives the same automaton, bit for bit, on one machine.
///
/// @throws std::invalid_argument with one line naming configuration, edge, criterion and reason if
/// a
///         maneuver is infeasible or was not found (see ManeuverSolution::reason)
[[nodiscard]] UniversalAutomaton build_automaton(const AutomatonConfiguration& configuration);

/// The same, ready for a Subgraph.
[[nodiscard]] std::shared_ptr<const UniversalAutomaton> build_shared_automaton(
    const AutomatonConfiguration& configuration);

}  // namespace hlc
