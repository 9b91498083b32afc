#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/frame.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::search {

/// What became of a vertex. Every vertex has exactly one fate.
enum class Fate : std::uint8_t {
  kExpanded,   ///< taken from the open list; its children were generated
  kCollision,  ///< taken and dropped: the edge into it is not free
  kBound,      ///< left in the open list: f is no less than the cost of the plan found
  kOpen,       ///< left in the open list by a search that stopped early, or could not begin
  kGoal,       ///< taken, free and of depth n: it ended the search
};
inline constexpr std::size_t kFates = 5;

/// expanded, collision, bound, open, goal.
[[nodiscard]] const char* to_string(Fate fate);

/// A vertex of a recorded search; the edge into it is `maneuver`.
struct TreeVertex {
  Frame frame;
  const automaton::Maneuver* maneuver{};  ///< nullptr for the root
  TrimId trim;
  std::uint32_t parent{};  ///< index of a vertex generated earlier; 0 for the root
  std::uint32_t depth{};
  double cost_so_far_m2{};  ///< g, of the path from the root
  /// f = g + h: no plan through the vertex costs less. In the unit of SearchResult::cost: with
  /// weights of criteria, g and f differ by more than h (EdgeCosts).
  double estimate_m2{};
  Fate fate{Fate::kOpen};
};

/// All vertices of one best-first search, in the order of generation: the first is the root, and a
/// parent comes before its children. Needs as much memory as the search itself.
struct SearchTree {
  std::vector<TreeVertex> vertices;
};

/// Counts of the vertices of one depth.
struct DepthCounts {
  std::size_t generated{};
  std::array<std::size_t, kFates> fates{};  ///< by Fate; the sum is `generated`
  double least_estimate_m2{};               ///< of its vertices
};

/// By depth, from 0 to the largest with a vertex.
[[nodiscard]] std::vector<DepthCounts> counts_by_depth(const SearchTree& tree);

/// How many plans there are, and what became of them: a plan, free or not, is a path of n edges
/// from the start that ends in an equilibrium. It counts for the fate of the one vertex on it that
/// is not expanded, so the fates add up to `total` (exactly, up to 2^53).
struct PlanCounts {
  double total{};
  std::array<double, kFates> fates{};  ///< by Fate; nothing for kExpanded
};

[[nodiscard]] PlanCounts count_plans(const SearchTree& tree, const automaton::Subgraph& subgraph,
                                     const HorizonProblem& problem);

/// Vertices along the plan from the root, as far as they were generated.
[[nodiscard]] std::vector<std::uint32_t> path_along(
    const SearchTree& tree, const std::vector<const automaton::Maneuver*>& plan);

/// At most `most` vertices to be shown of a large tree, sorted; with every vertex also its parent.
/// First those that were taken from the open list, then the others, each in the order of
/// generation.
[[nodiscard]] std::vector<std::uint32_t> vertices_to_show(const SearchTree& tree, std::size_t most);

}  // namespace hlc::search
