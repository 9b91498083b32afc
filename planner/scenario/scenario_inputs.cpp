#include "planner/scenario/scenario_inputs.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "planner/scenario/lab_file.hpp"
#include "planner/scenario/named_subgraph.hpp"

namespace hlc::scenario {
namespace {

/// The command line's, otherwise the file's.
const automaton::SubgraphSpec& chosen_subgraph(
    const ScenarioValues& values, const ScenarioChoices& choices,
    const std::vector<automaton::SubgraphSpec>& subgraphs) {
  const std::string name = choices.subgraph.value_or(values.subgraph);
  if (const automaton::SubgraphSpec* spec = find_subgraph(subgraphs, name)) return *spec;
  if (choices.subgraph) {
    throw std::invalid_argument(
        fmt::format("subgraph {}, must be one of {}", name, names_of(subgraphs)));
  }
  values.node.fail("subgraph", "one of " + names_of(subgraphs));
}

/// The inputs that do not depend on the automaton.
ScenarioInputs load_map(const ScenarioValues& values, const ScenarioChoices& choices) {
  ScenarioInputs inputs;
  if (values.circle) {
    if (!choices.map_file) return inputs;
    throw std::invalid_argument(
        fmt::format("--map: {} is a scenario without lanes; must be a scenario with `map`",
                    choices.file.string()));
  }
  inputs.map_file = choices.map_file ? choices.map_file : values.map_file;
  if (!inputs.map_file) values.node.fail("map", "text");
  inputs.map = road::read_lanelet_map(*inputs.map_file);
  inputs.map_obstacles = road::read_map_obstacles(*inputs.map_file);
  return inputs;
}

ScenarioInputs with_subgraph(ScenarioInputs inputs, const ScenarioValues& values,
                             std::shared_ptr<const automaton::Subgraph> subgraph) {
  inputs.subgraph = std::move(subgraph);
  if (values.lab_file) {
    inputs.lab = read_lab(*values.lab_file, inputs.subgraph->automaton().step_s);
  }
  return inputs;
}

}  // namespace

ScenarioInputs load_inputs(const ScenarioValues& values, const ScenarioChoices& choices) {
  ScenarioInputs inputs = load_map(values, choices);
  const bool may_ask_for_more = values.is_reconfigurable || !values.policies.empty();
  const auto choose =
      [&](const std::vector<automaton::SubgraphSpec>& offered) -> const automaton::SubgraphSpec& {
    return chosen_subgraph(values, choices, offered);
  };
  return with_subgraph(
      std::move(inputs), values,
      read_subgraph(values.automaton_file, choose,
                    may_ask_for_more ? BuildScope::kWhole : BuildScope::kSubgraph));
}

ScenarioInputs load_inputs(const ScenarioValues& values, const ScenarioChoices& choices,
                           std::shared_ptr<const automaton::UniversalAutomaton> automaton,
                           const std::vector<automaton::SubgraphSpec>& subgraphs) {
  const automaton::SubgraphSpec& spec = chosen_subgraph(values, choices, subgraphs);
  return with_subgraph(load_map(values, choices), values,
                       std::make_shared<automaton::Subgraph>(std::move(automaton), spec));
}

}  // namespace hlc::scenario
