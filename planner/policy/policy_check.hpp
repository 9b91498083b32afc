#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/policy/policy_settings.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc::policy {

/// All possible requests, each once; the first one is the empty request.
[[nodiscard]] std::vector<SubgraphRequest> requests_of(const ReconfigurationSettings& settings);

/// Tries every request that zones and policies may make: milliseconds, since no tables are made.
/// @param base  the scenario's subgraph
/// @param lab   limits of its vehicles; absent: none
/// @throws std::invalid_argument with the fault and its reason in one line: a request
/// (requested_subgraph), a limit (limited_subgraph), a maneuver that the lab's vehicles cannot
/// follow, a criterion of a look-ahead without a value for a maneuver
void check_reconfiguration(const automaton::Subgraph& base, const ReconfigurationSettings& settings,
                           std::size_t horizon_steps, const std::optional<vehicle::LabLimits>& lab);

}  // namespace hlc::policy
