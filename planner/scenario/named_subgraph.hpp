#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"

namespace hlc {

/// "A, B": the names of all.
[[nodiscard]] std::string names_of(const std::vector<SubgraphSpec>& subgraphs);

/// nullptr if none has that name.
[[nodiscard]] const SubgraphSpec* find_subgraph(const std::vector<SubgraphSpec>& subgraphs,
                                                const std::string& name);

/// One of the subgraphs that a file offers; throws if it offers no fitting one.
using ChooseSubgraph = std::function<const SubgraphSpec&(const std::vector<SubgraphSpec>& offered)>;

/// How much of a configuration is built.
enum class BuildScope {
  kSubgraph,  ///< what the subgraph needs
  kWhole,     ///< all of it: other subgraphs may be asked for later
};

/// A subgraph with its automaton: from a file that build_automaton has written, or from a
/// configuration, of which it builds what is needed (maneuvers are solved).
/// @throws std::invalid_argument with one line that names the file, or as `choose`
[[nodiscard]] std::shared_ptr<const Subgraph> read_subgraph(
    const std::filesystem::path& automaton_file, const ChooseSubgraph& choose,
    BuildScope scope = BuildScope::kSubgraph);

}  // namespace hlc
