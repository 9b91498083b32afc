#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/best_first/search_tree.hpp"
#include "planner/search/collision.hpp"
#include "planner/search/cost_to_go.hpp"
#include "planner/search/edge_costs.hpp"
#include "planner/search/frame.hpp"
#include "planner/search/search_engine.hpp"

namespace hlc::search {

/// Best-first search (A*) over vertices (pose, trim, depth).
///
/// The vertices form a tree: the root is the start at depth 0, a vertex of depth j < n has one
/// child for each edge of the subgraph whose target can still stand at the end,
///
///     distance_to_standstill(child's trim) <= n - (j + 1),
///
/// (and is not near the steering limit, if the problem avoids that; and only the first edge may
/// turn the wheels of a standing vehicle), so every vertex of depth n stands. The open list is
/// ordered by f = g + h (cost-to-come + cost-to-go), then deeper first, then in the order of
/// generation; hence two searches of one problem agree in everything. The maneuvers' own costs
/// (EdgeCosts) belong to g, their least sum over the rest of the path to h.
///
/// Collision checks are lazy: the edge into a vertex is checked when the vertex is taken from the
/// open list, and the vertex is dropped if the edge is not free. The root has no such edge and is
/// not checked: its pose is given.
///
/// The first free vertex of depth n taken from the open list ends the search. Its path costs least
/// if h is admissible (all except `CostToGo::kReferenceSpeed`): every other path still has a vertex
/// in the open list whose f, a lower bound of that path's cost, is not smaller.
///
/// The incumbent changes no count. It is the result if the search stops early; the least f in the
/// open list then bounds the cost of every path from below (with kReferenceSpeed:
/// least_cost_of_problem).
///
/// Counts: `generated` are all vertices made, including the root and children that are never
/// checked; `expanded` are those whose children were made, so neither dropped vertices nor the
/// goal.
class BestFirstSearch final : public SearchEngine {
 public:
  /// @param subgraph, reachable  must outlive this object; `reachable` belongs to `subgraph`
  BestFirstSearch(const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
                  SearchOptions options);
  using SearchEngine::search;

  /// A disabled trim may start with its exit edges (Subgraph); without any there is no path.
  /// @pre the start is finite, horizon_steps() <= reachable.max_steps(),
  ///      obstacles_m.size() is 0 or n, reference_speed_mps.size() is n (unless `kReferenceSpeed`:
  ///      or 0)
  void search(const HorizonProblem& problem, const std::function<bool()>& stop,
              SearchResult& result) override;

  /// Overwrites `tree` with all vertices of each later search; it changes no result and no count.
  /// @param tree  must outlive the searches; nullptr: nothing is recorded
  /// @pre the cost-to-go is admissible, otherwise f would not be a bound
  void record_in(SearchTree* tree);

 private:
  using VertexId = std::uint32_t;

  /// An edge of the subgraph with the data that the search needs.
  struct Step {
    const automaton::Maneuver* maneuver;
    Frame displacement;
    TrimId to;
    std::size_t distance_to_standstill;
    bool ends_at_limit;
    bool turns_in_place;
    double cost;  ///< EdgeCosts::reduced_cost
  };

  struct Vertex {
    Frame frame;
    double cost_to_come;
    const automaton::Maneuver* maneuver;  ///< of the edge into this vertex; nullptr for the root
    TrimId trim;
    VertexId parent;
    std::uint32_t depth;
  };

  struct OpenEntry {
    double cost_estimate{};
    VertexId vertex{};
    std::uint32_t depth{};
  };
  struct Before {
    bool operator()(const OpenEntry& a, const OpenEntry& b) const;
  };

  /// Whether the plan's step number `depth`, from 0, may be this one.
  [[nodiscard]] static bool permits(const HorizonProblem& problem, const Step& step,
                                    std::size_t depth);
  template <typename OpenList>
  void expand(VertexId vertex, const HorizonProblem& problem, const CostToGoFunction& cost_to_go,
              OpenList& open);
  [[nodiscard]] bool incoming_edge_is_free(const Vertex& vertex);
  void end_at_goal(VertexId goal, const HorizonProblem& problem, bool has_incumbent,
                   SearchResult& result) const;
  [[nodiscard]] double lower_bound(double estimate, const HorizonProblem& problem) const;
  /// Writes maneuvers, poses and cost of the incumbent; nothing, and false, if it is no free path.
  bool write_incumbent(const HorizonProblem& problem, SearchResult& result);
  [[nodiscard]] const Step* find_step(TrimId trim, const automaton::Maneuver* maneuver) const;
  [[nodiscard]] double cost_of(VertexId vertex, std::size_t steps) const;
  void write_path(VertexId goal, const HorizonProblem& problem, SearchResult& result) const;
  void record(VertexId id, double estimate, std::size_t horizon_steps);
  void record(VertexId id, Fate fate);
  void end_record(const SearchResult& result);

  const automaton::Subgraph& subgraph_;
  const automaton::ReachableSets& reachable_;
  SearchOptions options_;
  CollisionCheck collision_;
  EdgeCosts costs_;
  std::vector<std::vector<Step>> steps_;  ///< out of each trim
  std::vector<Vertex> vertices_;          ///< of the current search, in the order of generation
  SearchTree* tree_{nullptr};             ///< records `vertices_`; may be nullptr
};

}  // namespace hlc::search
