#pragma once

#include <cstddef>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

struct PlainResult {
  bool feasible{false};
  double cost{};                                      ///< [m^2]; only if feasible
  std::vector<const automaton::Maneuver*> maneuvers;  ///< n of them; empty unless feasible
  std::size_t generated{};                            ///< vertices made, the root included
  std::size_t expanded{};                             ///< vertices whose successors were made
};

/// Textbook best-first search (A*) for horizon problems: what the engines of planner/search are
/// measured against. It shares no code with them, only the problem, the automaton and polygons.
///
/// An open list in a std::priority_queue, ordered by f = g + h, then deeper first, then in the
/// order of generation; one vertex on the heap each; the edge into a vertex is checked when the
/// vertex is taken from the open list (most vertices never are), polygon against polygon with the
/// separating axis test after a comparison of boxes. A vertex of depth j has a child for each edge
/// whose target can still stand at the end: distance_to_standstill <= n - (j + 1).
///
/// Cost-to-go of a vertex at p with m steps to go:
///
///     h = sum_{i=1}^{m} max(0, || p - r_i || - i d)^2   [m^2]
///
/// with d the longest displacement of all edges that are on. Every step leads at most d farther, so
/// h is admissible by the triangle inequality and the plan is one of least cost.
///
/// Written to be read, but not to be slow: headings are unit vectors, so that nothing needs
/// trigonometry, what is known before the search is prepared, and squares of distances are compared
/// before a root is taken. `incumbent` is ignored.
class PlainSearch {
 public:
  /// @param subgraph  must outlive this object
  explicit PlainSearch(const automaton::Subgraph& subgraph);

  /// @pre problem.obstacles_m.size() is 0 or n, problem.avoided_in_motion_m is empty
  [[nodiscard]] PlainResult search(const search::HorizonProblem& problem) const;

 private:
  friend class PlainRun;

  /// An edge of the subgraph: where it leads, in the frame of its start.
  struct Step {
    const automaton::Maneuver* maneuver;
    Point shift_m;
    Point turn;  ///< cosine and sine of the change of heading
    TrimId to;
    std::size_t distance_to_standstill;
    bool ends_at_limit;
  };

  std::vector<std::vector<Step>> steps_;  ///< out of each trim
  std::vector<std::size_t> distance_to_standstill_;
  double longest_m_{};  ///< d
};

}  // namespace hlc::test
