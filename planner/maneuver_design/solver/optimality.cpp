#include "planner/maneuver_design/solver/optimality.hpp"

#include <vector>

#include "planner/maneuver_design/solver/first_order.hpp"

namespace hlc::maneuver_design {
namespace {

constexpr double kActive = 1e-6;

void add_active(const ConstraintValues& constraints, double within,
                std::vector<Eigen::VectorXd>& active) {
  for (Eigen::Index i = 0; i < constraints.value.size(); ++i) {
    if (constraints.value(i) > -within) {
      active.emplace_back(constraints.jacobian.row(i).transpose());
    }
  }
}

}  // namespace

double first_order_residual_at(const Transcription& transcription, const Eigen::VectorXd& z,
                               const Eigen::VectorXd& gradient) {
  // If the least J has the value 0, its slope is rounding.
  constexpr double kNoSlope = 1e-13;
  if (gradient.norm() < kNoSlope) {
    return 0.0;
  }
  const ManeuverProblem& problem = transcription.problem();
  const DecisionVariables& variables = transcription.variables();
  std::vector<Eigen::VectorXd> active;
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    if (z(i) > variables.upper()(i) - kActive) {
      active.emplace_back(Eigen::VectorXd::Unit(z.size(), i));
    }
    if (z(i) < variables.lower()(i) + kActive) {
      active.emplace_back(-Eigen::VectorXd::Unit(z.size(), i));
    }
  }
  for (const Channel& channel : {speed_channel(problem), steering_channel(problem)}) {
    add_active(transcription.state_bounds(channel, z), kActive * channel.scale(), active);
  }
  if (!problem.path_constraints.empty()) {
    add_active(transcription.path_constraints(z), kActive, active);
  }
  if (!problem.cost_bounds.empty()) {
    add_active(transcription.cost_bounds(z), kActive, active);
  }
  Eigen::MatrixXd columns(z.size(), static_cast<Eigen::Index>(active.size()));
  for (std::size_t i = 0; i < active.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) = active[i];
  }
  return first_order_residual(gradient, transcription.end_conditions(z).jacobian.transpose(),
                              columns);
}

}  // namespace hlc::maneuver_design
