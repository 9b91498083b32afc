#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "planner/automaton/subgraph.hpp"
#include "planner/common/node.hpp"
#include "planner/policy/policy_settings.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc::scenario {

/// Reads the map `policies` of a scenario, by name. Each entry (specified in planner/policy):
///
///     zones        list of {x_m: [from, to], y_m: [from, to], max_speed_mps}, may be absent
///     zones_limit  subgraph (default) or reference, only with zones
///     rules        list, may be absent; each entry one of
///       time         list of {from_s, request}, by time
///       situation    {open_road: request, conflict: request, after_conflict_s (default 1)}
///       battery      {below_v, back_above_v (default below_v), request}
///       look_ahead   {candidates: list of requests, steps (default 8),
///                     criterion_weights: {criterion: m^2 per unit} (default none),
///                     least_gain (default 0.05), max_expansions}
///     min_stay_s   default 1
///
/// A request is a map; keys that are absent keep the scenario's value:
///
///     labels         list
///     max_speed_mps
///     enable_trims, disable_trims   lists of numbers from 1
///
/// @throws std::invalid_argument with one line, "file:line: key = value, must be ..."
[[nodiscard]] std::map<std::string, policy::ReconfigurationSettings> read_policies(
    const Node& scenario);

/// Tries every request of the policy, and the limit of every zone (check_reconfiguration).
/// @throws std::invalid_argument with one line: the place of the policies, its name and why one of
/// its requests is infeasible
void check_policy(const Node& scenario, const std::string& name,
                  const policy::ReconfigurationSettings& settings, const automaton::Subgraph& base,
                  std::size_t horizon_steps, const std::optional<vehicle::LabLimits>& lab);

}  // namespace hlc::scenario
