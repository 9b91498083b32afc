#include "planner/scenario/named_subgraph.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/maneuver_design/built_automaton.hpp"

namespace hlc::scenario {

std::string names_of(const std::vector<automaton::SubgraphSpec>& subgraphs) {
  std::vector<std::string> names;
  for (const automaton::SubgraphSpec& one : subgraphs) names.push_back(one.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

const automaton::SubgraphSpec* find_subgraph(const std::vector<automaton::SubgraphSpec>& subgraphs,
                                             const std::string& name) {
  const auto spec = std::ranges::find(subgraphs, name, &automaton::SubgraphSpec::name);
  return spec == subgraphs.end() ? nullptr : &*spec;
}

std::shared_ptr<const automaton::Subgraph> read_subgraph(
    const std::filesystem::path& automaton_file, const ChooseSubgraph& choose, BuildScope scope) {
  if (automaton::is_automaton_file(automaton_file)) {
    const automaton::AutomatonFile file =
        maneuver_design::read_current_automaton_file(automaton_file);
    return std::make_shared<automaton::Subgraph>(file.automaton, choose(file.subgraphs));
  }
  const maneuver_design::AutomatonConfiguration configuration =
      maneuver_design::read_automaton_configuration(automaton_file);
  const automaton::SubgraphSpec& spec = choose(configuration.subgraphs);
  return std::make_shared<automaton::Subgraph>(
      maneuver_design::build_shared_automaton(
          scope == BuildScope::kWhole ? configuration
                                      : maneuver_design::needed_by(spec, configuration)),
      spec);
}

}  // namespace hlc::scenario
