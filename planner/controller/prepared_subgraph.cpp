#include "planner/controller/prepared_subgraph.hpp"

#include <utility>

#include "planner/controller/planning_basis.hpp"
#include "planner/search/search_tables.hpp"

namespace hlc::controller {

PreparedSubgraph prepare_subgraph(std::shared_ptr<const automaton::Subgraph> subgraph,
                                  std::size_t horizon_steps, const search::SearchOptions& search) {
  auto reachable = std::make_shared<const automaton::ReachableSets>(*subgraph, horizon_steps + 1);
  auto tables = search::make_search_tables(*subgraph, *reachable, search);
  const std::uint64_t digest = digest_of(*subgraph);
  return {.subgraph = std::move(subgraph),
          .reachable = std::move(reachable),
          .tables = std::move(tables),
          .digest = digest};
}

}  // namespace hlc::controller
