#include "planner/maneuver_design/solver/decision_variables.hpp"

#include <algorithm>
#include <cmath>

namespace hlc::maneuver_design {
namespace {

/// Shifts the values that can move that way, evenly and not beyond -1 ... 1, so that their mean
/// grows by `shift`, except for the part cut by the bounds; false if none can.
template <class Values>
bool shift_within_bounds(Values& values, double shift) {
  const auto room = [&](double value) { return shift > 0.0 ? 1.0 - value : value + 1.0; };
  double open = 0.0;
  for (const double value : values) {
    open += room(value) > 0.0 ? 1.0 : 0.0;
  }
  if (open == 0.0) {
    return false;
  }
  const double share = shift * static_cast<double>(values.size()) / open;
  for (double& value : values) {
    if (room(value) > 0.0) {
      value = std::clamp(value + share, -1.0, 1.0);
    }
  }
  return true;
}

}  // namespace

DecisionVariables::DecisionVariables(const ManeuverProblem& problem, double unit_s)
    : intervals_(static_cast<Eigen::Index>(problem.intervals)),
      is_free_(problem.free_duration.has_value()),
      unit_s_(unit_s),
      input_max_(problem.limits.acceleration_mps2, problem.limits.steering_rate_radps),
      lower_(Eigen::VectorXd::Constant(size(), -1.0)),
      upper_(Eigen::VectorXd::Constant(size(), 1.0)) {
  if (is_free_) {
    lower_(size() - 1) = problem.free_duration->min_s / unit_s;
    upper_(size() - 1) = problem.free_duration->max_s / unit_s;
  }
}

std::vector<vehicle::Input> DecisionVariables::inputs(const Eigen::VectorXd& z) const {
  std::vector<vehicle::Input> inputs(static_cast<std::size_t>(intervals_));
  for (Eigen::Index k = 0; k < intervals_; ++k) {
    inputs[static_cast<std::size_t>(k)] = {z(2 * k) * input_max_.x(),
                                           z(2 * k + 1) * input_max_.y()};
  }
  return inputs;
}

Eigen::VectorXd DecisionVariables::variables(const std::vector<vehicle::Input>& inputs,
                                             double duration_s) const {
  Eigen::VectorXd z = Eigen::VectorXd::Constant(size(), duration_s / unit_s_);
  for (Eigen::Index k = 0; k < intervals_; ++k) {
    const vehicle::Input& u = inputs[static_cast<std::size_t>(k)];
    z(2 * k) = u.acceleration_mps2 / input_max_.x();
    z(2 * k + 1) = u.steering_rate_radps / input_max_.y();
  }
  return z;
}

Eigen::VectorXd DecisionVariables::by_variables(const Eigen::VectorXd& by_input,
                                                double by_duration) const {
  Eigen::VectorXd result = Eigen::VectorXd::Constant(size(), by_duration * unit_s_);
  for (Eigen::Index i = 0; i < 2 * intervals_; ++i) {
    result(i) = by_input(i) * input_max_(i % 2);
  }
  return result;
}

void meet_end_condition(const Channel& channel, const DecisionVariables& variables,
                        Eigen::VectorXd& z) {
  // Clamping at a bound reduces the shift: shift the rest again.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    auto values = variables.of(channel, z);
    const double shift = variables.wanted_mean(channel, variables.duration_s(z)) - values.mean();
    if (shift == 0.0 || !shift_within_bounds(values, shift)) {
      return;
    }
  }
}

}  // namespace hlc::maneuver_design
