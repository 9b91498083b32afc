#include "planner/scenario/named_subgraph.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/maneuver_design/built_automaton.hpp"

namespace hlc {

std::string names_of(const std::vector<SubgraphSpec>& subgraphs) {
  std::vector<std::string> names;
  for (const SubgraphSpec& one : subgraphs) names.push_back(one.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

const SubgraphSpec* find_subgraph(const std::vector<SubgraphSpec>& subgraphs,
                                  const std::string& name) {
  const auto spec = std::ranges::find(subgraphs, name, &SubgraphSpec::name);
  return spec == subgraphs.end() ? nullptr : &*spec;
}

std::shared_ptr<const Subgraph> read_subgraph(const std::filesystem::path& automaton_file,
                                              const ChooseSubgraph& choose, BuildScope scope) {
  if (is_automaton_file(automaton_file)) {
    const AutomatonFile file = read_current_automaton_file(automaton_file);
    return std::make_shared<Subgraph>(file.automaton, choose(file.subgraphs));
  }
  const AutomatonConfiguration configuration = read_automaton_configuration(automaton_file);
  const SubgraphSpec& spec = choose(configuration.subgraphs);
  return std::make_shared<Subgraph>(
      build_shared_automaton(scope == BuildScope::kWhole ? configuration
                                                         : needed_by(spec, configuration)),
      spec);
}

}  // namespace hlc
