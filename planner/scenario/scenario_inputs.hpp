#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/scenario_values.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc {

/// What a scenario is driven on: the contents of the files that it names.
struct ScenarioInputs {
  std::optional<std::filesystem::path> map_file;  ///< none: a scenario without lanes
  std::optional<LaneletMap> map;
  std::shared_ptr<const Subgraph> subgraph;
  std::optional<LabLimits> lab;
};

/// Reads map and lab, and loads the automaton or builds what the scenario needs of it
/// (read_subgraph; maneuvers are solved).
/// @throws std::invalid_argument, std::runtime_error with one line that names the file, or the flag
/// of the command line that does not fit
[[nodiscard]] ScenarioInputs load_inputs(const ScenarioValues& values,
                                         const ScenarioChoices& choices);

/// The same with the automaton and the subgraphs that it offers at hand.
[[nodiscard]] ScenarioInputs load_inputs(const ScenarioValues& values,
                                         const ScenarioChoices& choices,
                                         std::shared_ptr<const UniversalAutomaton> automaton,
                                         const std::vector<SubgraphSpec>& subgraphs);

}  // namespace hlc
