#pragma once

#include <string>

#include "planner/maneuver_design/solver/transcription.hpp"

namespace hlc::maneuver_design {

struct SlsqpOptions {
  double cost_tolerance{1e-12};  ///< relative
  int max_evaluations{2000};
};

struct SlsqpResult {
  Eigen::VectorXd z;
  bool converged{};
  std::string reason;  ///< why not, if it did not converge
};

/// One run of NLopt's SLSQP (sequential quadratic programming) on a transcribed problem, with the
/// end conditions and the inequalities that `constraints` names. Variables whose element of
/// `active_bounds` is not 0 keep their value in `start`: NLopt removes them from the problem, and
/// the time of an iteration falls with the third power of the number of the others.
[[nodiscard]] SlsqpResult run_slsqp(const Transcription& transcription,
                                    const ConstraintSet& constraints, const Eigen::VectorXd& start,
                                    const Eigen::ArrayXi& active_bounds,
                                    const SlsqpOptions& options);

}  // namespace hlc::maneuver_design
