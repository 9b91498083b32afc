#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"

namespace hlc::scenario {

/// The names of all, "A, B".
[[nodiscard]] std::string names_of(const std::vector<automaton::SubgraphSpec>& subgraphs);

/// nullptr if none has that name.
[[nodiscard]] const automaton::SubgraphSpec* find_subgraph(
    const std::vector<automaton::SubgraphSpec>& subgraphs, const std::string& name);

/// Chooses one of the subgraphs in a file; throws if none fits.
using ChooseSubgraph = std::function<const automaton::SubgraphSpec&(
    const std::vector<automaton::SubgraphSpec>& offered)>;

/// Part of a configuration to build.
enum class BuildScope {
  kSubgraph,  ///< the part that the subgraph needs
  kWhole,     ///< all of it: other subgraphs may be requested later
};

/// A subgraph with its automaton: from a file of build_automaton, or from a configuration, of which
/// the needed part is built (maneuvers are solved).
/// @throws std::invalid_argument with one line that names the file, or as `choose`
[[nodiscard]] std::shared_ptr<const automaton::Subgraph> read_subgraph(
    const std::filesystem::path& automaton_file, const ChooseSubgraph& choose,
    BuildScope scope = BuildScope::kSubgraph);

}  // namespace hlc::scenario
