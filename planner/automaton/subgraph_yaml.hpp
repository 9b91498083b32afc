#pragma once

#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/common/node.hpp"

namespace hlc::automaton {

/// The file's part that its subgraphs refer to.
struct SubgraphContext {
  const std::vector<Trim>& trims;
  const vehicle::VehicleParameters& vehicle;
  const vehicle::VehicleLimits& limits;
  double step_s{};
  std::size_t horizon_steps{};
  const std::vector<std::string>& labels;  ///< of the automaton
};

/// Reads the list `subgraphs` of a configuration or automaton file. Each entry:
///
///     name                   not empty
///     label: J2              one label for all edges, or
///     labels: [J1, J2]       several: between two trims there is one edge for each
///     trims: all, or a list of numbers from 1
///     rule: chain (default) | reachable            (EdgeRule)
///     max_speed_mps          speed limit along maneuvers, optional
///     disabled_edges: list of {from, to, label (default: every label)}
///                            an edge out of an enabled trim must be one that the rule gives,
///                            with a label that it has
///     edges: list of {from, to, labels: [...]}     labels of single edges, instead of the above
///
/// @throws std::invalid_argument with one line, "file:line: key = value, must be ...": also if the
/// trims do not hang together (each must be reached from the first trim of speed 0 and reach
/// standstill within the horizon, over the edges that the rule gives and `disabled_edges` leaves;
/// what a speed limit takes away is known only once the maneuvers are, see Subgraph)
[[nodiscard]] std::vector<SubgraphSpec> read_subgraphs(const Node& file,
                                                       const SubgraphContext& context);

/// The same entry as text, one line of YAML ("{name: B, ...}"): reads back to the same spec.
[[nodiscard]] std::string to_yaml(const SubgraphSpec& spec);

}  // namespace hlc::automaton
