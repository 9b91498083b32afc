#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/maneuver_design/dominance.hpp"
#include "planner/maneuver_design/solver/maneuver_solver.hpp"

namespace hlc::maneuver_design {

/// One maneuver, several criteria (paper, Eq. 2 and Fig. 1).
struct ParetoProblem {
  ManeuverProblem maneuver;
  std::vector<std::shared_ptr<const RunningCost>> criteria;  ///< J_1 ... J_K, K >= 2
};

struct ParetoPoint {
  Objectives objectives;      ///< J_1 ... J_K
  ManeuverSolution solution;  ///< its `cost` is that of what was minimised for this point
  bool is_dominated{};        ///< by another point of the front
};

/// Spacing of the points of a front of two criteria.
enum class Spacing {
  kAlongFront,       ///< equal distances between neighbours, criteria divided by their ranges
  kSecondCriterion,  ///< equal steps of J_2
};

/// Called after each solved problem: how many are done, and the maximum.
using ParetoProgress = std::function<void(std::size_t done, std::size_t of)>;

struct ParetoOptions {
  std::size_t points{31};  ///< at least 2; for more than two criteria: per bounded criterion
  Spacing spacing{Spacing::kAlongFront};
  ParetoProgress progress{};
};

struct ParetoFront {
  /// kOptimal if every point is an optimum; otherwise the first other status, with its reason.
  ManeuverStatus status{ManeuverStatus::kOptimal};
  std::string reason;
  /// Two criteria: from the optimum of J_2 to that of J_1. More: no order.
  std::vector<ParetoPoint> points;

  [[nodiscard]] std::vector<Objectives> objectives() const;
};

/// The front by the epsilon-constraint method: min J_1 subject to J_i <= eps_i, i = 2 ... K, for a
/// grid of eps between each J_i's best and worst value among the single optima of all criteria.
/// Also reaches points in dents of the front, which no weighted sum can.
///
/// Two criteria: the ends are the single optima (where several maneuvers are equally good, the one
/// that is best for the other criterion, if the gain is 1 % of its range), and eps is chosen for
/// the requested spacing of the points. Every point is a local optimum; it is started from its
/// neighbours and from weighted sums, and a point that is worse than a known one is solved again
/// from that. kAlongFront starts from the weighted sums and corrects eps by interpolation until the
/// distances differ from their mean by less than 2 %, at most four times. If the criteria do not
/// conflict (ranges below 1e-6 of their size) the front is one point.
///
/// More criteria: a full grid of `points` values per bounded criterion, without points whose bounds
/// cannot be met.
///
/// @pre K >= 2, points >= 2
[[nodiscard]] ParetoFront epsilon_constraint_front(const ParetoProblem& problem,
                                                   const ParetoOptions& options = {});

/// For comparison: min sum_i w_i J_i / (worst_i - best_i) with evenly spaced weights (for more than
/// two criteria: all multiples of 1 / (points - 1) that add up to 1). Finds no point in a dent, and
/// crowds where the front is strongly curved.
[[nodiscard]] ParetoFront weighted_sum_front(const ParetoProblem& problem,
                                             const ParetoOptions& options = {});

}  // namespace hlc::maneuver_design
