#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/road/route.hpp"
#include "planner/road/speed_sections.hpp"
#include "planner/scenario/scenario_values.hpp"

/// The reference speeds of a scenario: of each vehicle its own or the scenario's, and on a section
/// of its route not more than the section's.
///
/// A plan is near its reference on average, and may reach it by turns with a faster and a slower
/// trim: from 0 to 0.8 m/s and back is as far as at 0.4 m/s. That is not what is meant by a car
/// that is slower than others, so that it also has no faster trims than it needs.
namespace hlc::scenario {

/// The sections of the route on the map with this benchmarkID.
/// @throws std::invalid_argument with one line: it has sections, but not for this map
[[nodiscard]] std::vector<road::SpeedSection> speed_sections_of(const RouteValues& values,
                                                                const road::Route& route,
                                                                const std::string& benchmark_id);

/// Of a vehicle with this reference speed of its own: the scenario's subgraph without the trims
/// that are faster than the one needed, which is of those that are not slower than the speed the
/// straightest, of several the slowest. The scenario's subgraph itself if no trim is faster.
/// @throws std::invalid_argument as requested_subgraph
[[nodiscard]] std::shared_ptr<const automaton::Subgraph> subgraph_at(
    const std::shared_ptr<const automaton::Subgraph>& subgraph, double reference_speed_mps,
    std::size_t horizon_steps);

/// The scenario's subgraph, and those of vehicles with a speed of their own that are others.
[[nodiscard]] std::vector<std::shared_ptr<const automaton::Subgraph>> subgraphs_of(
    const ScenarioValues& values, const std::shared_ptr<const automaton::Subgraph>& subgraph);

/// @throws std::invalid_argument with one line if a value would not be kept: a vehicle's or
/// section's speed is higher than every trim's, or a section's than every vehicle's, or standstill
/// is out of a vehicle's reach without the faster trims
void check_reference_speeds(const ScenarioValues& values,
                            const std::shared_ptr<const automaton::Subgraph>& subgraph);

}  // namespace hlc::scenario
