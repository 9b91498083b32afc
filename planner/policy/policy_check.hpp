#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/policy/policy_settings.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc {

/// All that may be asked for, each once; the first asks for nothing.
[[nodiscard]] std::vector<SubgraphRequest> requests_of(const ReconfigurationSettings& settings);

/// Tries everything that zones and policies may ask for: milliseconds, since no tables are made.
/// @param base  the scenario's subgraph
/// @param lab   what its vehicles can follow; absent: anything
/// @throws std::invalid_argument saying in one line what cannot be and why: a request
/// (requested_subgraph), a limit (limited_subgraph), what the lab's vehicles cannot follow, a
/// criterion of a look-ahead that a maneuver holds no value of
void check_reconfiguration(const Subgraph& base, const ReconfigurationSettings& settings,
                           std::size_t horizon_steps, const std::optional<LabLimits>& lab);

}  // namespace hlc
