#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/maneuver_design/maneuver_problem.hpp"

namespace hlc::maneuver_design {

/// The variables z of the finite-dimensional problem: the inputs of all intervals, each divided by
/// its bound, z = (u_v0 / a, u_delta0 / r, u_v1 / a, ...); then, if the duration is free, tau = T /
/// (duration of the guess). So -1 <= z <= 1 except for tau.
class DecisionVariables {
 public:
  /// @param unit_s  duration at tau = 1
  DecisionVariables(const ManeuverProblem& problem, double unit_s);

  [[nodiscard]] Eigen::Index size() const { return 2 * intervals_ + (is_free_ ? 1 : 0); }
  [[nodiscard]] Eigen::Index intervals() const { return intervals_; }
  [[nodiscard]] bool has_tau() const { return is_free_; }
  [[nodiscard]] double tau(const Eigen::VectorXd& z) const {
    return is_free_ ? z(size() - 1) : 1.0;
  }
  [[nodiscard]] double unit_s() const { return unit_s_; }
  [[nodiscard]] double duration_s(const Eigen::VectorXd& z) const { return tau(z) * unit_s_; }
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }

  /// Bounds of u_v and u_delta: the inputs at z = 1.
  [[nodiscard]] const Eigen::Vector2d& input_max() const { return input_max_; }
  [[nodiscard]] std::vector<vehicle::Input> inputs(const Eigen::VectorXd& z) const;
  [[nodiscard]] Eigen::VectorXd variables(const std::vector<vehicle::Input>& inputs,
                                          double duration_s) const;
  /// Derivatives by z from those by u and T; `by_input` has 2 N elements or more.
  [[nodiscard]] Eigen::VectorXd by_variables(const Eigen::VectorXd& by_input,
                                             double by_duration) const;
  /// Elements of one channel, 2 k + index, as a strided view of z.
  [[nodiscard]] auto of(const Channel& channel, Eigen::VectorXd& z) const {
    return Eigen::Map<Eigen::VectorXd, 0, Eigen::InnerStride<2>>(z.data() + channel.index,
                                                                 intervals_);
  }
  [[nodiscard]] auto of(const Channel& channel, const Eigen::VectorXd& z) const {
    return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<2>>(z.data() + channel.index,
                                                                       intervals_);
  }

  /// Mean of a channel's z that the end condition requires; |mean| <= 1 is feasible.
  [[nodiscard]] double wanted_mean(const Channel& channel, double duration_s) const {
    return channel.change() / (duration_s * channel.input_max);
  }
  /// Change of a channel's state by one interval of z = 1, with tau = 1.
  [[nodiscard]] double change_per_unit(const Channel& channel) const {
    return unit_s_ / static_cast<double>(intervals_) * channel.input_max;
  }

 private:
  Eigen::Index intervals_;
  bool is_free_;
  double unit_s_;
  Eigen::Vector2d input_max_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
};

/// Shifts a channel's inputs within their bounds, evenly, so that the end condition holds to the
/// last bits.
void meet_end_condition(const Channel& channel, const DecisionVariables& variables,
                        Eigen::VectorXd& z);

}  // namespace hlc::maneuver_design
