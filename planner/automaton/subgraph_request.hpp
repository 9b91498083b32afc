#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/criterion.hpp"
#include "planner/automaton/trim_id.hpp"

namespace hlc {

/// A request to a running controller to plan on another subgraph: a change of the subgraph that its
/// scenario names. Every request is relative to that one, not to the request before, so a late
/// joiner needs only the last one; the empty request stands for the scenario's own.
struct SubgraphRequest {
  /// Of all maneuvers between different trims, instead of the scenario's; empty: unchanged.
  std::vector<std::string> labels{};
  /// Instead of labels: the criterion of all maneuvers between different trims, a plain weighted
  /// sum (see planner/maneuver_design). Maneuvers of such weights may have to be designed first;
  /// empty: `labels` decide.
  std::vector<CriterionWeight> weights{};
  std::optional<double> max_speed_mps{};  ///< instead of the scenario's; absent: unchanged
  std::vector<TrimId> enable_trims{};     ///< beside those of the scenario
  std::vector<TrimId> disable_trims{};
  std::vector<TrimPair> enable_edges{};  ///< of those that the scenario disables
  std::vector<TrimPair> disable_edges{};
  friend bool operator==(const SubgraphRequest&, const SubgraphRequest&) = default;
};

}  // namespace hlc
