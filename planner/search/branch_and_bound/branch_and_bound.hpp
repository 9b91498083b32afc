#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/frame.hpp"
#include "planner/search/search_engine.hpp"

namespace hlc::search {

struct SearchTables;

/// The fast engine: depth-first branch and bound over the same tree as BestFirstSearch.
///
/// Only the current path is kept. The children of its last vertex are tried in the order of f = g +
/// h, those generated first among equals; a child is pruned as soon as its f is no less than the
/// cost of the best complete path so far, or its edge is not free. When nothing is left, the best
/// path is a path of least cost: every path through a pruned child costs at least its f, hence no
/// less, or is not free.
///
/// **Bound.** As CostToGo::kReachable, but seen from the parent, so that the terms of the vertex
/// alone are computed once for all its children. For the edge t -> u with displacement T, with m
/// steps left after it,
///
///     h = sum_{i=1}^{m} e_i^2,   e_i = max(0, max_a (| n_a q_i - c_a | - w_a))
///
/// where q_i is the reference point of the i-th step after the edge, seen from the parent, n_a the
/// eight axes at 0, 22.5, ... 157.5 degrees of the parent's frame, and [c_a - w_a, c_a + w_a] the
/// interval that T S(u, i, m - i) covers along n_a (S: ReachableSets::positions_m, with its
/// allowance). Each e_i is the distance of q_i from a half-plane that contains the positions, so it
/// is admissible for the same automata as CostToGo::kReachable and under the same assumption. The
/// intervals depend on (edge, i, min(m - i, largest distance to standstill)) alone: a table, made
/// once. It holds whole numbers of 16 bits, so that a vector has four edges and four steps, of a
/// unit of an 819th of the longest displacement; rounding makes each e_i smaller by at most two
/// and a half of them. Where a reference point may lie farther than 40 longest displacements from a
/// vertex, they are compared one by one, in double precision, with the corners that the half-planes
/// of neighbouring axes make, too (TableStore::compute_bounds).
///
/// f includes the maneuvers' own costs (EdgeCosts), and h the least possible sum of those after the
/// edge.
///
/// **Collision.** The results are those of CollisionCheck. Obstacles that no edge of a plan can
/// meet in a step are dropped once per plan (PreparedObstacles). The rest that is near a rectangle
/// around all edges out of a vertex is moved into the vertex' frame, once for all its children; an
/// obstacle around the vertex itself blocks them all. A child that is tried is compared with these
/// by a separating-axis test in single precision, eight edges at a time, unless two areas touch to
/// within its rounding: then by the test of CollisionCheck itself. Polygons of more than eight
/// corners are compared piece by piece. Boundaries have rectangles around eight segments in a row.
///
/// **Work.** `search` allocates nothing if the problem is no larger (steps, obstacles and their
/// corners, boundary) than an earlier one and `result` is reused. Per vertex there is no
/// trigonometry, no virtual call and no allocation. The inner loop (kernel.hpp) exists for any
/// processor, for AVX2 and for AVX-512; the processor decides, and all give the same bits.
///
/// Children whose f differ in the last bits only, as many as a child's number needs, count as
/// equal: a best path may cost 2^-52 times the number of a trim's edges, relative to itself, more
/// than another.
///
/// Counts: `generated` are the root and all children whose f was computed; `expanded` their
/// parents.
class BranchAndBound final : public SearchEngine {
 public:
  /// In ascending order of speed.
  enum class Instructions { kPortable, kAvx2, kAvx512 };

  /// @param subgraph, reachable  must outlive this object; `reachable` belongs to `subgraph` and
  /// has at most 80 steps
  /// @param most  the most advanced set that may be used, if the processor has it
  /// @param tables  of this subgraph, these sets and options; none: the engine makes its own
  /// @throws std::invalid_argument unless options.cost_to_go is kReachable
  BranchAndBound(const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
                 SearchOptions options, Instructions most = Instructions::kAvx512,
                 std::shared_ptr<const SearchTables> tables = nullptr);
  ~BranchAndBound() override;
  using SearchEngine::search;

  /// A disabled trim may start with its exit edges (Subgraph); without any there is no path.
  /// @pre as BestFirstSearch::search
  void search(const HorizonProblem& problem, const std::function<bool()>& stop,
              SearchResult& result) override;

  /// The instruction set in use.
  [[nodiscard]] Instructions instructions() const;

  /// f of every edge out of the start, in the order of Subgraph::successors(start_trim), as in the
  /// search, without n EdgeCosts::least(); infinite for edges excluded by recursive feasibility or
  /// `avoids_steering_limit`. @pre as `search`, with a horizon of at least one step
  [[nodiscard]] std::vector<double> estimates(const HorizonProblem& problem);

  /// Prepares the obstacles and the boundary of a problem, for `is_free`; `search` does so itself.
  /// @pre as `estimates`
  /// @param problem  must stay unchanged while `is_free` is called
  void prepare(const HorizonProblem& problem);
  /// As CollisionCheck::is_free, for the problem prepared last.
  /// @pre `maneuver` is an edge of the subgraph out of one of its `start_trims`; 1 <= step <=
  /// horizon
  [[nodiscard]] bool is_free(const automaton::Maneuver& maneuver, std::size_t step,
                             const Frame& start) const;

 private:
  class Core;

  void place_incumbent(const HorizonProblem& problem);
  void write_best(const HorizonProblem& problem, SearchResult& result) const;

  const automaton::Subgraph& subgraph_;
  const automaton::ReachableSets& reachable_;
  SearchOptions options_;
  std::unique_ptr<Core> core_;
};

}  // namespace hlc::search
