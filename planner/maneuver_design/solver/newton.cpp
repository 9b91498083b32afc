#include "planner/maneuver_design/solver/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "planner/common/demand.hpp"
#include "planner/maneuver_design/solver/active_bounds.hpp"
#include "planner/maneuver_design/solver/active_set_qp.hpp"

namespace hlc::maneuver_design {
namespace {

QuadraticProblem model_at(const Transcription& transcription, const ConstraintSet& constraints,
                          const Eigen::VectorXd& z, const Eigen::VectorXd& gradient,
                          const std::vector<Eigen::Index>& free) {
  const DecisionVariables& variables = transcription.variables();
  const ConstraintValues bounds = transcription.inequalities(constraints, z);
  QuadraticProblem model;
  model.hessian = transcription.hessian(z, free);
  model.gradient = gradient(free);
  model.equalities = transcription.end_conditions(z).jacobian(Eigen::all, free);
  model.rows = bounds.jacobian(Eigen::all, free);
  // A point closer than this to a constraint is at it.
  constexpr double kNoRoom = 1e-12;
  const auto clamped = [](double room) { return room < kNoRoom ? 0.0 : room; };
  model.room = (-bounds.value).unaryExpr(clamped);
  model.upper = (variables.upper() - z)(free).unaryExpr(clamped);
  model.lower = -(z - variables.lower())(free).unaryExpr(clamped);
  return model;
}

/// z after a step that lowers the objective enough; nothing if there is none.
std::optional<Eigen::VectorXd> after_search(const Transcription& transcription,
                                            const Eigen::VectorXd& z, double value,
                                            const Eigen::VectorXd& step, double promised) {
  constexpr int kHalvings = 25;
  const DecisionVariables& variables = transcription.variables();
  double length = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const Eigen::VectorXd next =
        (z + length * step).cwiseMax(variables.lower()).cwiseMin(variables.upper());
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(value);
    if (transcription.objective(next, nullptr) <= value - 1e-4 * length * promised + rounding) {
      return next;
    }
    length *= 0.5;
  }
  return std::nullopt;
}

}  // namespace

NewtonResult newton(const Transcription& transcription, const ConstraintSet& constraints,
                    const Eigen::VectorXd& start) {
  HLC_DEMAND(!transcription.variables().has_tau() && !constraints.path && !constraints.cost_bounds);
  constexpr int kRounds = 40;
  constexpr double kSmallStep = 1e-9;
  constexpr double kSmallGain = 1e-15;
  NewtonResult result{start, false};
  Eigen::VectorXd gradient;
  for (int round = 0; round < kRounds; ++round) {
    const double value = transcription.objective(result.z, &gradient);
    const std::vector<Eigen::Index> free =
        free_variables(transcription, constraints, result.z, gradient);
    const QuadraticProblem model = model_at(transcription, constraints, result.z, gradient, free);
    const Eigen::VectorXd part = local_minimum(model);
    const double promised = -model.gradient.dot(part) - 0.5 * part.dot(model.hessian * part);
    if (part.size() == 0 || part.lpNorm<Eigen::Infinity>() < kSmallStep || promised < kSmallGain) {
      result.converged = true;
      // A last step is always taken if there is one: it costs nothing and doubles the digits.
      if (part.size() > 0 && part.lpNorm<Eigen::Infinity>() < 1e-4) {
        Eigen::VectorXd step = Eigen::VectorXd::Zero(result.z.size());
        step(free) = part;
        result.z = (result.z + step)
                       .cwiseMax(transcription.variables().lower())
                       .cwiseMin(transcription.variables().upper());
      }
      return result;
    }
    Eigen::VectorXd step = Eigen::VectorXd::Zero(result.z.size());
    step(free) = part;
    const std::optional<Eigen::VectorXd> next =
        after_search(transcription, result.z, value, step, promised);
    if (!next) {
      return result;
    }
    result.z = *next;
  }
  return result;
}

}  // namespace hlc::maneuver_design
