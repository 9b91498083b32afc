#pragma once

#include <cstddef>
#include <vector>

#include "planner/maneuver_design/pareto_front.hpp"

namespace hlc::maneuver_design {

/// Common to the methods of pareto_front.hpp: the problems solved for one point each.

/// Relative to a criterion's range: smaller differences are the solver's noise.
inline constexpr double kDominanceTolerance = 1e-6;
/// Relative to a criterion's range: maneuvers as good as the optimum.
inline constexpr double kEqualCost = 1e-7;
/// Share of its range that another criterion must gain from a choice among equally good maneuvers.
inline constexpr double kWorthIt = 0.01;

/// The optimum of each criterion alone, and their range.
struct SingleOptima {
  std::vector<ParetoPoint> points;
  ObjectiveRange range;

  [[nodiscard]] double width(std::size_t criterion) const;
  /// True if the criteria conflict at all.
  [[nodiscard]] bool have_range() const;
};

/// Solves for the single optima; fewer than there are criteria, and the status of `front`, if one
/// is not found. Where different maneuvers are equally good for a criterion, the one among them
/// that is best for another criterion, if it is clearly better there: otherwise the ends would not
/// belong to the front.
[[nodiscard]] SingleOptima single_optima(const ParetoProblem& problem, ParetoFront& front);

/// Range of the criteria over the single optima.
[[nodiscard]] ObjectiveRange range_over(const SingleOptima& optima);

/// A solution with the values of all criteria; without them if it has no inputs.
[[nodiscard]] ParetoPoint point_of(const ParetoProblem& problem, ManeuverSolution solution);

/// Adds a solution's status to that of the front; true if it is an optimum.
bool is_optimal(const ManeuverSolution& solution, ParetoFront& front);

/// min J_1 subject to J_i <= eps_i; `eps` starts with i = 2.
/// @param start  inputs to start from; empty: the solver's guess, also if `start` leads nowhere
[[nodiscard]] ManeuverSolution bounded(const ParetoProblem& problem, const SingleOptima& optima,
                                       const std::vector<double>& eps,
                                       const std::vector<vehicle::Input>& start);

/// min sum_i w_i J_i / (worst_i - best_i)
[[nodiscard]] ManeuverSolution weighted(const ParetoProblem& problem, const SingleOptima& optima,
                                        const std::vector<double>& weights);

/// `points` - 2 equidistant values of a criterion between its best and its worst.
[[nodiscard]] std::vector<double> equal_steps(const SingleOptima& optima, std::size_t criterion,
                                              std::size_t points);

/// Counts solved problems for a progress display.
class ProgressCounter {
 public:
  ProgressCounter(const ParetoProgress& progress, std::size_t of) : progress_(progress), of_(of) {}

  void count() {
    if (progress_) {
      progress_(++done_, of_);
    }
  }

 private:
  const ParetoProgress& progress_;
  std::size_t of_;
  std::size_t done_{};
};

}  // namespace hlc::maneuver_design
