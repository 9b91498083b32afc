#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"

namespace hlc {

/// What a running controller is asked to plan on: a change of the subgraph that its scenario names.
/// Every request starts from that one, not from the request before, so whoever comes late needs
/// only the last one; the empty request asks for the scenario's own.
struct SubgraphRequest {
  /// Of all maneuvers between different trims, instead of the scenario's; empty: as they are.
  std::vector<std::string> labels{};
  std::optional<double> max_speed_mps{};  ///< instead of the scenario's; absent: as it is
  std::vector<TrimId> trims_on{};         ///< beside those of the scenario
  std::vector<TrimId> trims_off{};
  std::vector<TrimPair> edges_on{};  ///< of those that the scenario has off
  std::vector<TrimPair> edges_off{};
  friend bool operator==(const SubgraphRequest&, const SubgraphRequest&) = default;
};

/// The subgraph that is asked for, named after what differs ("B, labels J2, at most 0.6 m/s").
///
/// It drives as every declared one does: each trim that is on can be reached from standstill, and
/// reaches standstill within the horizon.
/// @param base           the scenario's
/// @throws std::invalid_argument saying in one line what is wrong and what is allowed: an unknown
/// trim or label, a trim on that is on or off that is off, a label that the automaton does not hold
/// for an edge, a speed below the slowest moving trim, standstill cut off
[[nodiscard]] std::shared_ptr<const Subgraph> requested_subgraph(const Subgraph& base,
                                                                 const SubgraphRequest& request,
                                                                 std::size_t horizon_steps);

}  // namespace hlc
