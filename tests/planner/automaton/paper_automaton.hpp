#pragma once

#include <memory>

#include "planner/maneuver_design/automaton_builder.hpp"
#include "tests/support/folders.hpp"

namespace hlc::automaton {

/// The shipped configuration of the paper's automaton.
inline const maneuver_design::AutomatonConfiguration& shipped_configuration() {
  static const maneuver_design::AutomatonConfiguration configuration =
      maneuver_design::read_automaton_configuration(test::source_folder() +
                                                    "/launch_scripts/automata/paper.yaml");
  return configuration;
}

/// The same with label J2 alone, which is quick to build: subgraphs B and D, D with J2 for J3.
inline const maneuver_design::AutomatonConfiguration& paper_configuration() {
  static const maneuver_design::AutomatonConfiguration configuration = [] {
    maneuver_design::AutomatonConfiguration result = shipped_configuration();
    result.criteria = {{"J2", {}, false}};
    std::erase_if(result.subgraphs, [](const SubgraphSpec& subgraph) {
      return subgraph.name != "B" && subgraph.name != "D";
    });
    for (SubgraphSpec& subgraph : result.subgraphs) subgraph.labels = {"J2"};
    return result;
  }();
  return configuration;
}

/// The automaton built from `paper_configuration`, once per test program.
inline std::shared_ptr<const UniversalAutomaton> paper_automaton() {
  static const auto automaton = maneuver_design::build_shared_automaton(paper_configuration());
  return automaton;
}

/// The pairs of different trims that the paper's four subgraphs need: 50.
inline std::vector<TrimPair> paper_edges() {
  std::vector<TrimPair> edges;
  for (const Maneuver& maneuver : paper_automaton()->maneuvers) {
    if (maneuver.from != maneuver.to) edges.push_back({maneuver.from, maneuver.to});
  }
  return edges;
}

/// Trim with the paper's number, from 1.
inline TrimId pi(std::size_t number) { return TrimId{number - 1}; }

}  // namespace hlc::automaton
