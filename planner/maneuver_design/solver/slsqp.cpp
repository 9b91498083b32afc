#include "planner/maneuver_design/solver/slsqp.hpp"

#include <fmt/format.h>

#include <nlopt.hpp>
#include <stdexcept>
#include <vector>

namespace hlc::maneuver_design {
namespace {

constexpr double kEndTolerance = 1e-13;
constexpr double kInequalityTolerance = 1e-10;

struct Context {
  const Transcription& transcription;
  ConstraintSet constraints;
  Eigen::Index end{};  ///< which end condition
};

Eigen::VectorXd vector_of(unsigned n, const double* z) {
  return Eigen::Map<const Eigen::VectorXd>(z, n);
}

double objective(unsigned n, const double* z, double* gradient, void* data) {
  const Context& context = *static_cast<const Context*>(data);
  if (gradient == nullptr) {
    return context.transcription.objective(vector_of(n, z), nullptr);
  }
  Eigen::VectorXd slope;
  const double value = context.transcription.objective(vector_of(n, z), &slope);
  Eigen::Map<Eigen::VectorXd>(gradient, n) = slope;
  return value;
}

void copy(const ConstraintValues& from, unsigned m, double* result, unsigned n, double* gradient) {
  Eigen::Map<Eigen::VectorXd>(result, m) = from.value;
  if (gradient != nullptr) {
    Eigen::Map<ConstraintValues::Jacobian>(gradient, m, n) = from.jacobian;
  }
}

double end_condition(unsigned n, const double* z, double* gradient, void* data) {
  const Context& context = *static_cast<const Context*>(data);
  const ConstraintValues ends = context.transcription.end_conditions(vector_of(n, z));
  if (gradient != nullptr) {
    Eigen::Map<Eigen::RowVectorXd>(gradient, n) = ends.jacobian.row(context.end);
  }
  return ends.value(context.end);
}

void inequalities(unsigned m, double* result, unsigned n, const double* z, double* gradient,
                  void* data) {
  const Context& context = *static_cast<const Context*>(data);
  copy(context.transcription.inequalities(context.constraints, vector_of(n, z)), m, result, n,
       gradient);
}

std::vector<double> list_of(const Eigen::VectorXd& z) { return {z.data(), z.data() + z.size()}; }

}  // namespace

SlsqpResult run_slsqp(const Transcription& transcription, const ConstraintSet& constraints,
                      const Eigen::VectorXd& start, const Eigen::ArrayXi& active_bounds,
                      const SlsqpOptions& options) {
  const DecisionVariables& variables = transcription.variables();
  const Eigen::VectorXd first = start.cwiseMax(variables.lower()).cwiseMin(variables.upper());
  Context context{transcription, constraints, 0};
  Context speed_end{transcription, constraints, 0};
  Context steering_end{transcription, constraints, 1};
  nlopt::opt slsqp(nlopt::LD_SLSQP, static_cast<unsigned>(first.size()));
  slsqp.set_lower_bounds(list_of((active_bounds != 0).select(first, variables.lower())));
  slsqp.set_upper_bounds(list_of((active_bounds != 0).select(first, variables.upper())));
  slsqp.set_min_objective(objective, &context);
  const ConstraintValues ends = transcription.end_conditions(first);
  for (Context* const end : {&speed_end, &steering_end}) {
    // An end condition without a variable already holds, and would only make the matrix singular.
    if ((ends.jacobian.row(end->end).transpose().array() != 0.0 && active_bounds == 0).any()) {
      slsqp.add_equality_constraint(end_condition, end, kEndTolerance);
    }
  }
  const Eigen::Index rows = transcription.inequalities(constraints, first).value.size();
  if (rows > 0) {
    slsqp.add_inequality_mconstraint(
        inequalities, &context,
        std::vector<double>(static_cast<std::size_t>(rows), kInequalityTolerance));
  }
  slsqp.set_ftol_rel(options.cost_tolerance);
  constexpr double kRounding = 1e-16;  // where the least value is 0, nothing is relative to it
  slsqp.set_ftol_abs(kRounding);
  slsqp.set_maxeval(options.max_evaluations);

  SlsqpResult result;
  std::vector<double> z = list_of(first);
  double value = 0.0;
  try {
    const nlopt::result code = slsqp.optimize(z, value);
    result.converged = code != nlopt::MAXEVAL_REACHED;
    if (!result.converged) {
      result.reason = fmt::format("not converged after {} evaluations", options.max_evaluations);
    }
  } catch (const nlopt::roundoff_limited&) {
    // No further progress is possible in floating point: as good as converged. The residuals
    // decide.
    result.converged = true;
  } catch (const std::runtime_error& error) {
    result.reason = std::string("NLopt: ") + error.what();
  }
  result.z = Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size()));
  return result;
}

}  // namespace hlc::maneuver_design
