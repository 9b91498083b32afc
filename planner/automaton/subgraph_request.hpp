#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/criterion.hpp"
#include "planner/automaton/trim_id.hpp"

namespace hlc {

/// What a running controller is asked to plan on: a change of the subgraph that its scenario names.
/// Every request starts from that one, not from the request before, so whoever comes late needs
/// only the last one; the empty request asks for the scenario's own.
struct SubgraphRequest {
  /// Of all maneuvers between different trims, instead of the scenario's; empty: as they are.
  std::vector<std::string> labels{};
  /// Instead of labels: what all maneuvers between different trims are to be optimal for, a plain
  /// weighted sum (see planner/maneuver_design). Maneuvers of such weights may have to be made
  /// first; empty: `labels` say it.
  std::vector<CriterionWeight> weights{};
  std::optional<double> max_speed_mps{};  ///< instead of the scenario's; absent: as it is
  std::vector<TrimId> trims_on{};         ///< beside those of the scenario
  std::vector<TrimId> trims_off{};
  std::vector<TrimPair> edges_on{};  ///< of those that the scenario has off
  std::vector<TrimPair> edges_off{};
  friend bool operator==(const SubgraphRequest&, const SubgraphRequest&) = default;
};

}  // namespace hlc
