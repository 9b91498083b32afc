#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::search {

/// The criteria with a value for every edge of the subgraph, in the order of the first edge.
[[nodiscard]] std::vector<std::string> criteria_of(const automaton::Subgraph& subgraph);

/// A plan's costs by its maneuvers' own criteria, beside the distance from the reference: of the
/// maneuver e, with the weights w_c >= 0 and its criterion values c(e),
///
///     w(e) = sum_c w_c c(e)   [m^2]
///
/// A criterion may be negative (J1 is), costs in a search must not be: a search adds
/// `reduced_cost(e)` = w(e) - least(), the least over all edges of the subgraph, and n least() to
/// the result. All plans have n maneuvers, so the order of plans is the same.
class EdgeCosts {
 public:
  /// @throws std::invalid_argument for a weight that is not a number from 0 to 1e9
  /// (SearchOptions::kMostWeight_m2), or a criterion without a value for an edge of the subgraph
  EdgeCosts(const automaton::Subgraph& subgraph, const std::vector<PlanningWeight>& weights,
            std::size_t max_steps);

  /// No weights: everything is 0.
  [[nodiscard]] bool is_zero() const { return weights_.empty(); }
  [[nodiscard]] double least() const { return least_; }
  /// @pre `maneuver` is an edge of the subgraph
  [[nodiscard]] double reduced_cost(const automaton::Maneuver& maneuver) const;

  /// The least sum of `reduced_cost` over the `steps` edges of any path from `trim` that ends in an
  /// equilibrium, reduced by more than the rounding of such a sum. A lower bound, exact except for
  /// obstacles, for every automaton: it is computed from the edges that are searched.
  /// @pre distance_to_standstill(trim) <= steps <= max_steps
  [[nodiscard]] double to_go(TrimId trim, std::size_t steps) const;

 private:
  [[nodiscard]] double weighted(const automaton::Maneuver& maneuver) const;
  [[nodiscard]] double least_to_go(std::span<const automaton::Edge> edges,
                                   const std::vector<double>& after_edge) const;

  std::vector<PlanningWeight> weights_;
  double least_{};
  std::vector<std::vector<double>> to_go_;  ///< by steps, then trim; nothing without weights
};

}  // namespace hlc::search
