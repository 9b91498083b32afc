#include "planner/maneuver_design/solver/active_set_qp.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hlc::maneuver_design {
namespace {

constexpr double kTolerance = 1e-11;  // of gradient and multipliers, relative to the gradient

class ActiveSet {
 public:
  explicit ActiveSet(const QuadraticProblem& problem)
      : q_(problem),
        p_(Eigen::VectorXd::Zero(problem.gradient.size())),
        at_bound_(static_cast<std::size_t>(p_.size()), 0),
        row_is_active_(static_cast<std::size_t>(problem.rows.rows()), false),
        scale_(std::max(problem.gradient.lpNorm<Eigen::Infinity>(),
                        std::numeric_limits<double>::min())) {
    for (Eigen::Index i = 0; i < p_.size(); ++i) {
      if (q_.upper(i) <= 0.0) {
        side(i) = 1;
      } else if (q_.lower(i) >= 0.0) {
        side(i) = -1;
      }
    }
    for (Eigen::Index i = 0; i < q_.rows.rows(); ++i) {
      is_active(i) = q_.room(i) <= 0.0;
    }
  }

  [[nodiscard]] Eigen::VectorXd minimum() {
    const Eigen::Index max_steps = 20 * (p_.size() + q_.rows.rows() + 1);
    for (Eigen::Index step = 0; step < max_steps; ++step) {
      find_null_space();
      const Eigen::VectorXd slope = q_.gradient + q_.hessian * p_;
      const Eigen::VectorXd reduced = null_space_.transpose() * slope(free_);
      if (reduced.size() > 0 && reduced.lpNorm<Eigen::Infinity>() > kTolerance * scale_) {
        move(slope, reduced);
      } else if (!release(slope)) {
        break;
      }
    }
    return p_;
  }

 private:
  int& side(Eigen::Index i) { return at_bound_[static_cast<std::size_t>(i)]; }
  std::vector<bool>::reference is_active(Eigen::Index row) {
    return row_is_active_[static_cast<std::size_t>(row)];
  }

  /// Of the active constraints, within the free variables.
  void find_null_space() {
    free_.clear();
    active_.clear();
    for (Eigen::Index i = 0; i < p_.size(); ++i) {
      if (side(i) == 0) {
        free_.push_back(i);
      }
    }
    for (Eigen::Index i = 0; i < q_.rows.rows(); ++i) {
      if (is_active(i)) {
        active_.push_back(i);
      }
    }
    const auto num_free = static_cast<Eigen::Index>(free_.size());
    const Eigen::Index num_equalities = q_.equalities.rows();
    normals_.resize(p_.size(), num_equalities + static_cast<Eigen::Index>(active_.size()));
    normals_.leftCols(num_equalities) = q_.equalities.transpose();
    for (std::size_t i = 0; i < active_.size(); ++i) {
      normals_.col(num_equalities + static_cast<Eigen::Index>(i)) =
          q_.rows.row(active_[i]).transpose();
    }
    if (num_free == 0 || normals_.cols() == 0) {
      null_space_.setIdentity(num_free, num_free);
      return;
    }
    factors_.compute(normals_(free_, Eigen::all));
    const Eigen::Index rank = factors_.rank();
    null_space_.setZero(num_free, num_free - rank);
    null_space_.bottomRows(num_free - rank).setIdentity();
    null_space_.applyOnTheLeft(factors_.householderQ());
  }

  void move(const Eigen::VectorXd& slope, const Eigen::VectorXd& reduced) {
    const Eigen::MatrixXd curvature =
        null_space_.transpose() * q_.hessian(free_, free_) * null_space_;
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(p_.size());
    double longest = 1.0;
    const Eigen::LLT<Eigen::MatrixXd> factors(curvature);
    if (factors.info() == Eigen::Success) {
      direction(free_) = -null_space_ * factors.solve(reduced);
    } else {
      // Downhill, most where the curvature is negative; ends at a constraint.
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(curvature);
      const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
      const Eigen::VectorXd sizes =
          eigen.eigenvalues().cwiseAbs().cwiseMax(1e-8 * std::max(largest, 1e-300));
      direction(free_) =
          -null_space_ * (eigen.eigenvectors() *
                          (eigen.eigenvectors().transpose() * reduced).cwiseQuotient(sizes));
      const double bend = direction.dot(q_.hessian * direction);
      longest = bend > 0.0 ? -slope.dot(direction) / bend : std::numeric_limits<double>::infinity();
    }
    advance(direction, longest);
  }

  /// Up to `longest` times the direction, or to the first blocking constraint, which becomes
  /// active.
  void advance(const Eigen::VectorXd& direction, double longest) {
    double step = longest;
    const Eigen::Index bound = first_bound(direction, step);
    const Eigen::Index row = first_row(direction, step);
    if (!std::isfinite(step)) {
      return;  // no bound blocks a direction of 0
    }
    p_ += step * direction;
    if (row >= 0) {
      is_active(row) = true;
    } else if (bound >= 0) {
      side(bound) = direction(bound) > 0.0 ? 1 : -1;
      p_(bound) = direction(bound) > 0.0 ? q_.upper(bound) : q_.lower(bound);
    }
  }

  /// The free variable whose bound is reached first, before `step`, which then ends there; -1:
  /// none.
  [[nodiscard]] Eigen::Index first_bound(const Eigen::VectorXd& direction, double& step) const {
    Eigen::Index bound = -1;
    for (const Eigen::Index i : free_) {
      const double limit = direction(i) > 0.0 ? q_.upper(i) : q_.lower(i);
      if (direction(i) != 0.0 && (limit - p_(i)) / direction(i) < step) {
        step = std::max((limit - p_(i)) / direction(i), 0.0);
        bound = i;
      }
    }
    return bound;
  }

  /// The same among the rows that are not active.
  [[nodiscard]] Eigen::Index first_row(const Eigen::VectorXd& direction, double& step) {
    Eigen::Index row = -1;
    const Eigen::VectorXd along = q_.rows * direction;
    const Eigen::VectorXd used = q_.rows * p_;
    for (Eigen::Index i = 0; i < along.size(); ++i) {
      if (!is_active(i) && along(i) > 1e-14 && (q_.room(i) - used(i)) / along(i) < step) {
        step = std::max((q_.room(i) - used(i)) / along(i), 0.0);
        row = i;
      }
    }
    return row;
  }

  /// Drops the constraint whose multiplier has the wrong sign most; false if none has.
  bool release(const Eigen::VectorXd& slope) {
    Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(normals_.cols());
    if (!free_.empty() && normals_.cols() > 0) {
      multipliers = factors_.solve(-slope(free_));
    }
    const Eigen::VectorXd remains = slope + normals_ * multipliers;
    double worst = kTolerance * scale_;
    Eigen::Index bound = -1;
    Eigen::Index row = -1;
    for (Eigen::Index i = 0; i < p_.size(); ++i) {
      const bool can_leave = side(i) != 0 && q_.upper(i) > q_.lower(i);
      if (can_leave && side(i) * remains(i) > worst) {
        worst = side(i) * remains(i);
        bound = i;
      }
    }
    for (std::size_t i = 0; i < active_.size(); ++i) {
      const double multiplier = multipliers(q_.equalities.rows() + static_cast<Eigen::Index>(i));
      if (-multiplier > worst) {
        worst = -multiplier;
        row = active_[i];
      }
    }
    if (row >= 0) {
      is_active(row) = false;
    } else if (bound >= 0) {
      side(bound) = 0;
    }
    return row >= 0 || bound >= 0;
  }

  const QuadraticProblem& q_;
  Eigen::VectorXd p_;
  std::vector<int> at_bound_;  ///< 1 at the upper, -1 at the lower bound, 0 free
  std::vector<bool> row_is_active_;
  double scale_;
  std::vector<Eigen::Index> free_;
  std::vector<Eigen::Index> active_;
  Eigen::MatrixXd normals_;                              ///< columns: equalities, then active rows
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors_;  ///< of normals_(free_, :)
  Eigen::MatrixXd null_space_;
};

}  // namespace

Eigen::VectorXd local_minimum(const QuadraticProblem& problem) {
  return ActiveSet(problem).minimum();
}

}  // namespace hlc::maneuver_design
