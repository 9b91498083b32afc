#pragma once

#include <Eigen/Core>
#include <vector>

namespace hlc::maneuver_design {

/// A small dense quadratic problem around a feasible point:
///
///     min over p of  g^T p + p^T H p / 2,   E p = 0,   C p <= room,   lower <= p <= upper
///
/// H may be indefinite (J1 is concave in the acceleration). p = 0 is feasible: room >= 0, lower <=
/// 0 <= upper, all bounds finite.
struct QuadraticProblem {
  Eigen::MatrixXd hessian;     ///< H, n x n, symmetric
  Eigen::VectorXd gradient;    ///< g, n
  Eigen::MatrixXd equalities;  ///< E, (any) x n
  Eigen::MatrixXd rows;        ///< C, (any) x n
  Eigen::VectorXd room;
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

/// A local minimum of the problem, by the primal active-set method (Nocedal and Wright, Numerical
/// Optimization, 2006, Algorithm 16.3): within the active constraints it takes the Newton step in
/// their null space, or, where the curvature there is negative, goes downhill to the next
/// constraint; where it cannot go further, it drops the constraint whose multiplier has the wrong
/// sign most. Every step lowers the value, so the result is never worse than p = 0; after 20 (n +
/// rows) steps it stops.
[[nodiscard]] Eigen::VectorXd local_minimum(const QuadraticProblem& problem);

}  // namespace hlc::maneuver_design
