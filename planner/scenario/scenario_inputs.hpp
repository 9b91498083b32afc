#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/road/map_obstacles.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/scenario_values.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc::scenario {

/// The files that a scenario names, read.
struct ScenarioInputs {
  std::optional<std::filesystem::path> map_file;  ///< none: a scenario without lanes
  std::optional<road::LaneletMap> map;
  std::vector<road::MapObstacle> map_obstacles;  ///< what stands on it
  std::shared_ptr<const automaton::Subgraph> subgraph;
  std::optional<vehicle::LabLimits> lab;
};

/// Reads map and lab, and loads the automaton or builds the part that the scenario needs
/// (read_subgraph; maneuvers are solved).
/// @throws std::invalid_argument, std::runtime_error with one line that names the file, or the flag
/// that does not fit
[[nodiscard]] ScenarioInputs load_inputs(const ScenarioValues& values,
                                         const ScenarioChoices& choices);

/// The same with a given automaton and its subgraphs.
[[nodiscard]] ScenarioInputs load_inputs(
    const ScenarioValues& values, const ScenarioChoices& choices,
    std::shared_ptr<const automaton::UniversalAutomaton> automaton,
    const std::vector<automaton::SubgraphSpec>& subgraphs);

}  // namespace hlc::scenario
