#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::controller {

/// A subgraph with everything that planning on it needs, so that a switch costs hardly more than a
/// planner (Controller::switch_to). It never changes: it can be made in advance on any thread, and
/// shared by controllers.
struct PreparedSubgraph {
  std::shared_ptr<const automaton::Subgraph> subgraph;
  /// For one step more than the horizon
  std::shared_ptr<const automaton::ReachableSets> reachable;
  std::shared_ptr<const search::SearchTables> tables;  ///< none if the engine needs none
  std::uint64_t digest{};                              ///< digest_of the subgraph
};

/// Milliseconds for a dozen trims, more than a second for a hundred.
/// @param search  options of the controller's search
/// @throws std::invalid_argument if an edge holds no value of a criterion of the planning cost
[[nodiscard]] PreparedSubgraph prepare_subgraph(std::shared_ptr<const automaton::Subgraph> subgraph,
                                                std::size_t horizon_steps,
                                                const search::SearchOptions& search);

}  // namespace hlc::controller
