#include "planner/maneuver_design/solver/transcription.hpp"

#include <cmath>

#include "planner/maneuver_design/shooting.hpp"
#include "planner/maneuver_design/solver/sensitivities.hpp"

namespace hlc::maneuver_design {
namespace {

/// Value of a cost at z, and its derivatives by z if `gradient` is not null.
double value_of(const RunningCost& cost, const ManeuverProblem& problem,
                const DecisionVariables& variables, const Eigen::VectorXd& z,
                Eigen::VectorXd* gradient) {
  const Shot shot =
      shoot(start_state(problem), variables.inputs(z), variables.duration_s(z), cost,
            problem.vehicle, gradient == nullptr ? WithGradient::kNo : WithGradient::kYes);
  if (gradient != nullptr) {
    const Eigen::Map<const Eigen::VectorXd> by_input(shot.gradient.front().data(),
                                                     2 * variables.intervals());
    *gradient = variables.by_variables(by_input, shot.duration_gradient);
  }
  return shot.cost;
}

}  // namespace

Transcription::Transcription(const ManeuverProblem& problem, const RunningCost& cost, double unit_s,
                             double tie_break)
    : problem_(problem), cost_(cost), variables_(problem, unit_s), tie_break_(tie_break) {}

void Transcription::scale_at(const Eigen::VectorXd& z) {
  const double size = std::abs(cost(z, nullptr));
  unit_ = size > 0.0 ? size : 1.0;
}

double Transcription::cost(const Eigen::VectorXd& z, Eigen::VectorXd* gradient) const {
  ++evaluations_;
  return value_of(cost_, problem_, variables_, z, gradient);
}

double Transcription::objective(const Eigen::VectorXd& z, Eigen::VectorXd* gradient) const {
  const double value = cost(z, gradient) / unit_;
  const auto inputs = z.head(2 * variables_.intervals());
  const double share = tie_break_ / static_cast<double>(inputs.size());
  if (gradient != nullptr) {
    *gradient /= unit_;
    gradient->head(inputs.size()) += 2.0 * share * inputs;
  }
  return value + share * inputs.squaredNorm();
}

Eigen::MatrixXd Transcription::hessian(const Eigen::VectorXd& z,
                                       const std::vector<Eigen::Index>& variables) const {
  constexpr double kStep = 1e-4;
  const std::vector<vehicle::Input> inputs = variables_.inputs(z);
  const double interval_s = variables_.duration_s(z) / static_cast<double>(inputs.size());
  const std::vector<vehicle::State> states =
      shoot(start_state(problem_), inputs, variables_.duration_s(z), cost_, problem_.vehicle,
            WithGradient::kNo)
          .states;
  const auto slopes_after = [&](Eigen::Index variable, double step) {
    Eigen::VectorXd shifted = z;
    shifted(variable) += step;
    const auto first = static_cast<std::ptrdiff_t>(variable / 2);
    const std::vector<vehicle::Input> all = variables_.inputs(shifted);
    const std::vector<vehicle::Input> rest(all.begin() + first, all.end());
    ++evaluations_;
    return shoot(states[static_cast<std::size_t>(first)], rest,
                 interval_s * static_cast<double>(rest.size()), cost_, problem_.vehicle,
                 WithGradient::kYes)
        .gradient;
  };
  const Eigen::Vector2d unit = variables_.input_max() / (2.0 * kStep * unit_);
  const auto size = static_cast<Eigen::Index>(variables.size());
  Eigen::MatrixXd result(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    const Eigen::Index variable = variables[static_cast<std::size_t>(column)];
    const auto above = slopes_after(variable, kStep);
    const auto below = slopes_after(variable, -kStep);
    for (Eigen::Index row = column; row < size; ++row) {
      const Eigen::Index other = variables[static_cast<std::size_t>(row)];
      const auto interval = static_cast<std::size_t>(other / 2 - variable / 2);
      result(row, column) =
          (above[interval](other % 2) - below[interval](other % 2)) * unit(other % 2);
      result(column, row) = result(row, column);
    }
    result(column, column) += 2.0 * tie_break_ / static_cast<double>(2 * variables_.intervals());
  }
  return result;
}

ConstraintValues Transcription::end_conditions(const Eigen::VectorXd& z) const {
  ConstraintValues ends{Eigen::VectorXd(2), ConstraintValues::Jacobian::Zero(2, z.size())};
  for (const Channel& channel : {speed_channel(problem_), steering_channel(problem_)}) {
    const double mean = variables_.of(channel, z).mean();
    const double tau = variables_.tau(z);
    ends.value(channel.index) = tau * mean - variables_.wanted_mean(channel, variables_.unit_s());
    for (Eigen::Index k = 0; k < variables_.intervals(); ++k) {
      ends.jacobian(channel.index, 2 * k + channel.index) =
          tau / static_cast<double>(variables_.intervals());
    }
    if (variables_.has_tau()) {
      ends.jacobian(channel.index, z.size() - 1) = mean;
    }
  }
  return ends;
}

ConstraintValues Transcription::state_bounds(const Channel& channel,
                                             const Eigen::VectorXd& z) const {
  const Eigen::Index inner = variables_.intervals() - 1;
  ConstraintValues bounds{Eigen::VectorXd(2 * inner),
                          ConstraintValues::Jacobian::Zero(2 * inner, z.size())};
  const double per_unit = variables_.tau(z) * variables_.change_per_unit(channel);
  double state = channel.from;
  for (Eigen::Index k = 0; k < inner; ++k) {
    state += per_unit * z(2 * k + channel.index);
    bounds.value(2 * k) = state - channel.state_max;
    bounds.value(2 * k + 1) = channel.state_min - state;
    auto above = bounds.jacobian.row(2 * k);
    for (Eigen::Index i = 0; i <= k; ++i) {
      above(2 * i + channel.index) = per_unit;
    }
    if (variables_.has_tau()) {
      above(z.size() - 1) = (state - channel.from) / variables_.tau(z);
    }
    bounds.jacobian.row(2 * k + 1) = -above;
  }
  return bounds;
}

ConstraintValues Transcription::path_constraints(const Eigen::VectorXd& z) const {
  const std::vector<vehicle::Input> inputs = variables_.inputs(z);
  const double duration_s = variables_.duration_s(z);
  const std::vector<vehicle::State> states =
      shoot(start_state(problem_), inputs, duration_s, cost_, problem_.vehicle, WithGradient::kNo)
          .states;
  const auto slopes = sensitivities(states, inputs, duration_s, problem_.vehicle);
  const auto size = static_cast<Eigen::Index>(2 * inputs.size() * problem_.path_constraints.size());
  ConstraintValues path{Eigen::VectorXd(size), ConstraintValues::Jacobian(size, z.size())};
  Eigen::Index row = 0;
  for (const auto& constraint : problem_.path_constraints) {
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      for (const std::size_t end : {k, k + 1}) {
        const vehicle::StateVector x = vehicle::to_vector(states[end]);
        path.value(row) = constraint->value(x, inputs[k]);
        const CostGradient g = constraint->gradient(x, inputs[k]);
        Eigen::VectorXd slope = slopes[end].transpose() * g.state;
        slope.segment<2>(2 * static_cast<Eigen::Index>(k)) += g.input;
        path.jacobian.row(row) =
            variables_.by_variables(slope, slope(slope.size() - 1)).transpose();
        ++row;
      }
    }
  }
  return path;
}

ConstraintValues Transcription::cost_bounds(const Eigen::VectorXd& z) const {
  const auto size = static_cast<Eigen::Index>(problem_.cost_bounds.size());
  ConstraintValues bounds{Eigen::VectorXd(size), ConstraintValues::Jacobian(size, z.size())};
  Eigen::VectorXd gradient;
  for (Eigen::Index i = 0; i < size; ++i) {
    const CostBound& bound = problem_.cost_bounds[static_cast<std::size_t>(i)];
    const double value = value_of(*bound.cost, problem_, variables_, z, &gradient);
    bounds.value(i) = (value - bound.max) / bound.scale();
    bounds.jacobian.row(i) = gradient.transpose() / bound.scale();
  }
  return bounds;
}

ConstraintValues Transcription::inequalities(const ConstraintSet& constraints,
                                             const Eigen::VectorXd& z) const {
  std::vector<ConstraintValues> kinds;
  if (constraints.speed) {
    kinds.push_back(state_bounds(speed_channel(problem_), z));
  }
  if (constraints.steering) {
    kinds.push_back(state_bounds(steering_channel(problem_), z));
  }
  if (constraints.path) {
    kinds.push_back(path_constraints(z));
  }
  if (constraints.cost_bounds) {
    kinds.push_back(cost_bounds(z));
  }
  Eigen::Index rows = 0;
  for (const ConstraintValues& kind : kinds) {
    rows += kind.value.size();
  }
  ConstraintValues all{Eigen::VectorXd(rows), ConstraintValues::Jacobian(rows, z.size())};
  Eigen::Index row = 0;
  for (const ConstraintValues& kind : kinds) {
    all.value.segment(row, kind.value.size()) = kind.value;
    all.jacobian.middleRows(row, kind.value.size()) = kind.jacobian;
    row += kind.value.size();
  }
  return all;
}

}  // namespace hlc::maneuver_design
