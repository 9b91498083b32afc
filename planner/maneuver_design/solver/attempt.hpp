#pragma once

#include <string>

#include "planner/maneuver_design/solver/maneuver_solver.hpp"
#include "planner/maneuver_design/solver/transcription.hpp"

namespace hlc::maneuver_design {

/// A point z and its evaluation.
struct Candidate {
  Eigen::VectorXd z;
  double objective{};
  bool within_bounds{};  ///< all constraints hold
  double residual{};     ///< first-order, of the objective
  std::string reason;    ///< why the solver stopped early, if it did
};

/// Finds the optimum of a problem. From each starting point:
///
///  1. Nothing more if the first-order conditions already hold (J2).
///  2. The fast way: a few rounds of SLSQP in the variables without a clearly active bound, then
///     Newton. With more than 20 intervals, the solution with 20 replaces SLSQP.
///  3. The slow way, if that does not lead to an optimum, and for free durations, g_i and bounds on
///     costs, which Newton's method does not support: SLSQP in all variables, restarted from where
///     it stopped if necessary.
///
/// Bounds on states and g_i are added to the solvers' constraints only once a result violates them.
class Attempt {
 public:
  /// @param unit_s  duration at which the search starts
  /// @pre the problem is feasible according to feasibility_of
  Attempt(const ManeuverProblem& problem, const RunningCost& cost, const SolverOptions& options,
          double unit_s);

  /// The best optimum reached from the starting points.
  [[nodiscard]] Candidate solved();

  [[nodiscard]] const Transcription& transcription() const { return transcription_; }
  /// Evaluations of the cost so far, on any number of intervals.
  [[nodiscard]] int evaluations() const {
    return transcription_.evaluations() + coarse_evaluations_;
  }

 private:
  [[nodiscard]] Candidate solved_from(const Eigen::VectorXd& start);
  [[nodiscard]] Candidate after_quick_way(const Candidate& start);
  [[nodiscard]] Candidate after_long_way(const Eigen::VectorXd& start, const Candidate& quick);
  [[nodiscard]] Candidate after_few_rounds(const Candidate& start);
  [[nodiscard]] Candidate refined(const Candidate& point);
  [[nodiscard]] Eigen::VectorXd from_coarse();
  [[nodiscard]] Candidate examined(Eigen::VectorXd z) const;
  [[nodiscard]] ConstraintResiduals residuals_at(const Eigen::VectorXd& z) const;
  [[nodiscard]] Eigen::ArrayXi active_bounds_at(const Eigen::VectorXd& z) const;
  [[nodiscard]] bool add_violated(const Eigen::VectorXd& z);
  [[nodiscard]] bool newton_applies() const;
  [[nodiscard]] bool starts_coarse() const;

  const ManeuverProblem& problem_;
  const RunningCost& cost_;
  const SolverOptions& options_;
  Transcription transcription_;
  ConstraintSet constraints_;
  int coarse_evaluations_{};
};

}  // namespace hlc::maneuver_design
