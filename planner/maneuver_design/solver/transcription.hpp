#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/maneuver_design/solver/decision_variables.hpp"

namespace hlc::maneuver_design {

/// Constraints of one kind at a point: their values and, row by row, their derivatives.
struct ConstraintValues {
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::VectorXd value;
  Jacobian jacobian;  ///< (number of constraints) x (size of z)
};

/// Kinds of inequality that a solver takes into account. Most maneuvers need none of them.
struct ConstraintSet {
  bool speed{};        ///< bounds on the speed at the inner interval bounds
  bool steering{};     ///< the same for the steering
  bool path{};         ///< g_i(x, u) <= 0
  bool cost_bounds{};  ///< J_i <= max

  friend bool operator==(const ConstraintSet&, const ConstraintSet&) = default;
};

/// A maneuver's problem as one of finite dimension (direct single shooting):
///
///     min f(z),   c_E(z) = 0,   c_I(z) <= 0,   lower <= z <= upper
///     f(z) = J / unit + tie_break mean_i(z_i^2)
///
/// `unit` is the size of J, because SLSQP takes a raw cost of 1e-3 for converged at once. The
/// second term is the effort in scaled inputs, at most 1: it decides between equal J.
///
/// Keeps references to the problem and the cost.
class Transcription {
 public:
  Transcription(const ManeuverProblem& problem, const RunningCost& cost, double unit_s,
                double tie_break);

  [[nodiscard]] const ManeuverProblem& problem() const { return problem_; }
  [[nodiscard]] const RunningCost& running_cost() const { return cost_; }
  [[nodiscard]] const DecisionVariables& variables() const { return variables_; }

  /// Makes |J| at this point the unit (1 if J is 0 there).
  void scale_at(const Eigen::VectorXd& z);
  /// f, and df if `gradient` is not null.
  double objective(const Eigen::VectorXd& z, Eigen::VectorXd* gradient) const;
  /// Second derivatives of f by those variables (in order, all of them inputs): central differences
  /// of the exact gradient. An input affects only the rest of the maneuver, so each column is a
  /// shot over that rest, and the other half follows by symmetry.
  [[nodiscard]] Eigen::MatrixXd hessian(const Eigen::VectorXd& z,
                                        const std::vector<Eigen::Index>& variables) const;
  /// J, and dJ/dz.
  double cost(const Eigen::VectorXd& z, Eigen::VectorXd* gradient) const;
  /// Evaluations of f or J so far.
  [[nodiscard]] int evaluations() const { return evaluations_; }

  /// c_E = tau mean(z of a channel) - wanted, 2.
  [[nodiscard]] ConstraintValues end_conditions(const Eigen::VectorXd& z) const;
  /// state_k - max and min - state_k at the inner interval bounds k = 1 ... N - 1; 2 (N - 1).
  [[nodiscard]] ConstraintValues state_bounds(const Channel& channel,
                                              const Eigen::VectorXd& z) const;
  /// All g_i at both ends of all intervals.
  [[nodiscard]] ConstraintValues path_constraints(const Eigen::VectorXd& z) const;
  /// (J_i - max_i) / scale of each bound on another cost.
  [[nodiscard]] ConstraintValues cost_bounds(const Eigen::VectorXd& z) const;
  /// All inequalities of the kinds that `constraints` names, one below the other.
  [[nodiscard]] ConstraintValues inequalities(const ConstraintSet& constraints,
                                              const Eigen::VectorXd& z) const;

 private:
  const ManeuverProblem& problem_;
  const RunningCost& cost_;
  DecisionVariables variables_;
  double tie_break_;
  double unit_{1.0};
  mutable int evaluations_{};
};

}  // namespace hlc::maneuver_design
