#pragma once

#include <Eigen/Core>

namespace hlc::maneuver_design {

/// Residual of the first-order conditions of optimality (Karush, Kuhn and Tucker) of  min f(z),
/// c_E(z) = 0, c_I(z) <= 0 :
///
///     min over lambda, mu >= 0 of  | df + C_E^T lambda + C_A^T mu |_2  /  | df |_2
///
/// with C_A the inequalities that are active at z. 0 at every local optimum (if the constraints are
/// regular there), 1 where no constraint explains the slope. 0 if df = 0.
///
/// @param gradient    df, n
/// @param equalities  columns are the gradients of c_E, n x (any)
/// @param active      columns are the gradients of the active c_I, n x (any)
[[nodiscard]] double first_order_residual(const Eigen::VectorXd& gradient,
                                          const Eigen::MatrixXd& equalities,
                                          const Eigen::MatrixXd& active);

}  // namespace hlc::maneuver_design
