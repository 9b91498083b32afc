#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"

namespace hlc {

/// What a universal automaton is built from. File: see launch_scripts/automata/paper.yaml.
struct AutomatonConfiguration {
  std::string source;  ///< file it was read from, for messages
  VehicleParameters vehicle;
  IdentifiedVehicle identified;
  VehicleLimits limits;
  std::vector<Trim> trims;
  double step_s{0.2};         ///< duration of every maneuver and of a trim's own step
  std::size_t intervals{20};  ///< of constant input, per maneuver
  std::vector<std::string>
      criteria;  ///< every edge is built for each of them; names see criteria.hpp
  std::vector<SubgraphSpec> subgraphs;  ///< together they say which edges are built
};

/// Reads a configuration. Keys:
///
///     vehicle:    {wheelbase_m, rear_axle_to_cg_m, length_m, width_m,
///                  safety_margin_m (default 0.010),
///                  identified: {... (see IdentifiedVehicle), all optional}}
///     limits:     {acceleration_mps2, steering_rate_radps, speed_min_mps, speed_max_mps,
///                  steering_max_rad}
///     trims:      list of {speed_mps, steering_rad}; their numbers count from 1 in this order
///     step_s
///     intervals   (default 20)
///     criteria:   list of names
///     subgraphs:  list of {name, label: one of the criteria, trims: all, or a list of numbers}
///
/// @throws std::invalid_argument with one line, "file:line: key = value, allowed ...", for whatever
/// is missing, unknown, of the wrong type or outside its range: trims must respect the limits and
/// differ, there must be a trim of speed 0 in every subgraph, subgraphs' names must differ.
[[nodiscard]] AutomatonConfiguration read_automaton_configuration(
    const std::filesystem::path& path);

}  // namespace hlc
