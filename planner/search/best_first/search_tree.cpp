#include "planner/search/best_first/search_tree.hpp"

#include <algorithm>

namespace hlc::search {
namespace {

std::size_t index_of(Fate fate) { return static_cast<std::size_t>(fate); }

bool was_taken(const TreeVertex& vertex) {
  return vertex.fate != Fate::kBound && vertex.fate != Fate::kOpen;
}

/// Whether a path may take the edge with `steps` steps to go, beside what standstill demands.
bool permits(const automaton::Subgraph& subgraph, const HorizonProblem& problem,
             const automaton::Edge& edge, std::size_t steps) {
  const bool is_first = steps == problem.horizon_steps() && problem.may_turn_in_place;
  if (turns_in_place(*edge.maneuver) && !is_first) return false;
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  return !problem.avoids_steering_limit ||
         !automaton::is_at_steering_limit(automaton.trims[edge.to.index], automaton.vehicle,
                                          automaton.identified);
}

/// Numbers of paths to an equilibrium, by steps left and trim.
std::vector<std::vector<double>> paths_to_go(const automaton::Subgraph& subgraph,
                                             const HorizonProblem& problem) {
  const std::size_t n = problem.horizon_steps();
  std::vector<std::vector<double>> paths(
      n + 1, std::vector<double>(subgraph.automaton().trims.size(), 0.0));
  for (const TrimId trim : subgraph.start_trims()) {
    paths[0][trim.index] = subgraph.distance_to_standstill(trim) == 0 ? 1.0 : 0.0;
  }
  for (std::size_t steps = 1; steps <= n; ++steps) {
    for (const TrimId trim : subgraph.start_trims()) {
      for (const automaton::Edge& edge : subgraph.successors(trim, steps)) {
        if (!permits(subgraph, problem, edge, steps)) continue;
        paths[steps][trim.index] += paths[steps - 1][edge.to.index];
      }
    }
  }
  return paths;
}

}  // namespace

const char* to_string(Fate fate) {
  switch (fate) {
    case Fate::kExpanded:
      return "expanded";
    case Fate::kCollision:
      return "collision";
    case Fate::kBound:
      return "bound";
    case Fate::kOpen:
      return "open";
    case Fate::kGoal:
      return "goal";
  }
  return "";
}

std::vector<DepthCounts> counts_by_depth(const SearchTree& tree) {
  std::vector<DepthCounts> depths;
  for (const TreeVertex& vertex : tree.vertices) {
    if (vertex.depth >= depths.size()) depths.resize(vertex.depth + 1);
    DepthCounts& depth = depths[vertex.depth];
    depth.least_estimate_m2 = depth.generated == 0
                                  ? vertex.estimate_m2
                                  : std::min(depth.least_estimate_m2, vertex.estimate_m2);
    ++depth.generated;
    ++depth.fates[index_of(vertex.fate)];
  }
  return depths;
}

PlanCounts count_plans(const SearchTree& tree, const automaton::Subgraph& subgraph,
                       const HorizonProblem& problem) {
  const std::vector<std::vector<double>> paths = paths_to_go(subgraph, problem);
  const std::size_t n = problem.horizon_steps();
  PlanCounts counts;
  counts.total = paths[n][problem.start_trim.index];
  for (const TreeVertex& vertex : tree.vertices) {
    if (vertex.fate == Fate::kExpanded) continue;
    counts.fates[index_of(vertex.fate)] += paths[n - vertex.depth][vertex.trim.index];
  }
  return counts;
}

std::vector<std::uint32_t> path_along(const SearchTree& tree,
                                      const std::vector<const automaton::Maneuver*>& plan) {
  if (tree.vertices.empty()) return {};
  std::vector<std::uint32_t> path{0};
  for (std::uint32_t id = 1; id < tree.vertices.size() && path.size() <= plan.size(); ++id) {
    const TreeVertex& vertex = tree.vertices[id];
    if (vertex.parent == path.back() && vertex.maneuver == plan[path.size() - 1]) {
      path.push_back(id);
    }
  }
  return path;
}

std::vector<std::uint32_t> vertices_to_show(const SearchTree& tree, std::size_t most) {
  std::vector<std::uint32_t> ids;
  // The parent of every vertex was expanded, so it was taken, and is found before.
  for (const bool taken : {true, false}) {
    for (std::uint32_t id = 0; id < tree.vertices.size() && ids.size() < most; ++id) {
      if (was_taken(tree.vertices[id]) == taken) ids.push_back(id);
    }
  }
  std::ranges::sort(ids);
  return ids;
}

}  // namespace hlc::search
