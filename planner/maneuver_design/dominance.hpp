#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace hlc::maneuver_design {

/// Values of several objectives of one solution; all are minimised.
using Objectives = Eigen::VectorXd;

/// True if `a` Pareto-dominates `b`: a_i <= b_i for all i and a_i < b_i for at least one i.
///
/// A strict partial order. Values that differ by no more than tolerance_i count as equal, so that a
/// solver's noise does not decide; transitivity then holds only up to that tolerance.
///
/// @param tolerance  one per objective, >= 0; empty: 0
/// @pre same size, order and units, no NaN
[[nodiscard]] bool dominates(const Objectives& a, const Objectives& b,
                             const Objectives& tolerance = {});

/// Indices of the points that no other one dominates, ascending. Of equal points all remain. The
/// set does not depend on the order of the points.
[[nodiscard]] std::vector<std::size_t> non_dominated(const std::vector<Objectives>& points,
                                                     const Objectives& tolerance = {});

/// Volume of the part of the space that is dominated by the points and not worse than `reference`
/// in any objective: the larger, the better the front. Points that are worse than the reference in
/// some objective add nothing. Any number of objectives, by slicing along the last one; time grows
/// as points^(objectives - 1).
[[nodiscard]] double hypervolume(std::vector<Objectives> points, const Objectives& reference);

/// Index of the knee: the point of least sum of (J_i - best_i) / (worst_i - best_i), best and worst
/// over the points; the first of equals. For two objectives it is the point farthest from the
/// straight line between the ends, on the good side. Objectives that do not vary do not count.
/// @pre points is not empty
[[nodiscard]] std::size_t knee_point(const std::vector<Objectives>& points);

/// Least and greatest value of each objective. @pre points is not empty
struct ObjectiveRange {
  Objectives best;
  Objectives worst;
};
[[nodiscard]] ObjectiveRange range_of(const std::vector<Objectives>& points);

}  // namespace hlc::maneuver_design
