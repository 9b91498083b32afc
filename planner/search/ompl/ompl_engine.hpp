#pragma once

#include <memory>

#include "planner/search/search_engine.hpp"

namespace hlc::search {

/// The engine that `options.engine` names, called through a RecedingHorizonPlanner, that is through
/// `ompl::base::Planner::solve`: results and counts are bitwise the engine's own. For users who
/// need OMPL between controller and engine; every plan takes some microseconds longer. An
/// EngineFactory: SearchOptions::factory.
/// @throws std::invalid_argument as make_search_engine
[[nodiscard]] std::unique_ptr<SearchEngine> make_ompl_engine(
    const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
    const SearchOptions& options, std::shared_ptr<const SearchTables> tables = nullptr);

}  // namespace hlc::search
