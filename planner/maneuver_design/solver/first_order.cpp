#include "planner/maneuver_design/solver/first_order.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <vector>

namespace hlc::maneuver_design {
namespace {

/// Least squares with the columns of the passive set only.
Eigen::VectorXd solved(const Eigen::MatrixXd& columns, const std::vector<Eigen::Index>& passive,
                       const Eigen::VectorXd& wanted) {
  Eigen::MatrixXd part(columns.rows(), static_cast<Eigen::Index>(passive.size()));
  for (std::size_t i = 0; i < passive.size(); ++i) {
    part.col(static_cast<Eigen::Index>(i)) = columns.col(passive[i]);
  }
  const Eigen::VectorXd values = part.colPivHouseholderQr().solve(wanted);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(columns.cols());
  for (std::size_t i = 0; i < passive.size(); ++i) {
    all(passive[i]) = values(static_cast<Eigen::Index>(i));
  }
  return all;
}

/// The steepest of the columns from `num_free` on that have no multiplier yet; -1 if none is steep.
Eigen::Index entering_column(const Eigen::VectorXd& slope, const Eigen::VectorXd& multipliers,
                             Eigen::Index num_free) {
  Eigen::Index entering = -1;
  double steepest = 1e-12;
  for (Eigen::Index i = num_free; i < slope.size(); ++i) {
    if (multipliers(i) == 0.0 && slope(i) > steepest) {
      steepest = slope(i);
      entering = i;
    }
  }
  return entering;
}

/// Moves the multipliers to the least squares of the passive set. A signed multiplier that would
/// lose its sign becomes 0 and leaves the set.
void solve_passive_set(const Eigen::MatrixXd& columns, const Eigen::VectorXd& wanted,
                       Eigen::Index num_free, std::vector<Eigen::Index>& passive,
                       Eigen::VectorXd& multipliers) {
  for (;;) {
    const Eigen::VectorXd target = solved(columns, passive, wanted);
    double step = 1.0;
    for (const Eigen::Index i : passive) {
      if (i >= num_free && target(i) <= 0.0) {
        step = std::min(step, multipliers(i) / (multipliers(i) - target(i)));
      }
    }
    if (step >= 1.0) {
      multipliers = target;
      return;
    }
    multipliers += step * (target - multipliers);
    std::erase_if(passive, [&](Eigen::Index i) {
      const bool leaves = i >= num_free && multipliers(i) <= 1e-14;
      if (leaves) {
        multipliers(i) = 0.0;
      }
      return leaves;
    });
  }
}

}  // namespace

// The active-set method of Lawson and Hanson (Solving Least Squares Problems, 1974, ch. 23), with
// the multipliers of the equalities, which have no sign, in the passive set for good.
double first_order_residual(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& equalities,
                            const Eigen::MatrixXd& active) {
  const double size = gradient.norm();
  if (size == 0.0) {
    return 0.0;
  }
  const Eigen::Index free = equalities.cols();
  Eigen::MatrixXd columns(gradient.size(), free + active.cols());
  columns << equalities, active;
  const Eigen::VectorXd wanted = -gradient / size;
  std::vector<Eigen::Index> passive;
  for (Eigen::Index i = 0; i < free; ++i) {
    passive.push_back(i);
  }
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(columns.cols());
  if (free > 0) {
    multipliers = solved(columns, passive, wanted);
  }
  const Eigen::Index max_rounds = 3 * columns.cols();
  for (Eigen::Index round = 0; round < max_rounds; ++round) {
    const Eigen::VectorXd slope = columns.transpose() * (wanted - columns * multipliers);
    const Eigen::Index entering = entering_column(slope, multipliers, free);
    if (entering < 0) {
      break;
    }
    passive.push_back(entering);
    solve_passive_set(columns, wanted, free, passive, multipliers);
  }
  return (wanted - columns * multipliers).norm();
}

}  // namespace hlc::maneuver_design
