#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/automaton/subgraph_request.hpp"

namespace hlc::automaton {

/// Label of maneuvers designed for these weights ("J1 0.3 J2 0.7"): the same for the same weights
/// in any order, without zero weights.
[[nodiscard]] std::string label_of(std::vector<CriterionWeight> weights);

/// The requested subgraph's specification, named after the differences ("B, labels J2, at most 0.6
/// m/s"). Weights become their label.
/// @param base  the scenario's
/// @throws std::invalid_argument with the error in one line, value and bound: an unknown trim or
/// label, both labels and weights, enabling an enabled or disabling a disabled trim, a speed below
/// the slowest moving trim
[[nodiscard]] SubgraphSpec requested_spec(const Subgraph& base, const SubgraphRequest& request);

/// The requested subgraph.
///
/// It fulfils what a declared one does: each enabled trim can be reached from standstill, and
/// reaches standstill within the horizon.
/// @param base       the scenario's
/// @param automaton  with the maneuvers of the weights, if any are requested; none: the base's
/// @throws std::invalid_argument as requested_spec; a label without a maneuver in the automaton for
/// an edge, standstill cut off
[[nodiscard]] std::shared_ptr<const Subgraph> requested_subgraph(
    const Subgraph& base, const SubgraphRequest& request, std::size_t horizon_steps,
    std::shared_ptr<const UniversalAutomaton> automaton = nullptr);

}  // namespace hlc::automaton
