#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/automaton/subgraph_request.hpp"

namespace hlc {

/// Label of maneuvers that were made for these weights ("J1 0.3 J2 0.7"): the same for the same
/// weights in any order, without those that are 0.
[[nodiscard]] std::string label_of(std::vector<CriterionWeight> weights);

/// What is to be on, named after what differs ("B, labels J2, at most 0.6 m/s"). Weights become
/// their label.
/// @param base  the scenario's
/// @throws std::invalid_argument saying in one line what is wrong and what is allowed: an unknown
/// trim or label, labels and weights, a trim on that is on or off that is off, a speed below the
/// slowest moving trim
[[nodiscard]] SubgraphSpec requested_spec(const Subgraph& base, const SubgraphRequest& request);

/// The subgraph that is asked for.
///
/// It drives as every declared one does: each trim that is on can be reached from standstill, and
/// reaches standstill within the horizon.
/// @param base       the scenario's
/// @param automaton  with the maneuvers of the weights, if any are asked for; none: the base's
/// @throws std::invalid_argument as requested_spec; a label that the automaton does not hold for an
/// edge, standstill cut off
[[nodiscard]] std::shared_ptr<const Subgraph> requested_subgraph(
    const Subgraph& base, const SubgraphRequest& request, std::size_t horizon_steps,
    std::shared_ptr<const UniversalAutomaton> automaton = nullptr);

}  // namespace hlc
