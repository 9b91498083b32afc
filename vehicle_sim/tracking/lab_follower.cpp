#include "vehicle_sim/tracking/lab_follower.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vehicle_sim/tracking/trajectory.hpp"

namespace hlc::tracking {
namespace {

constexpr double kStep_s = 0.05;
constexpr std::array kWeights{1.0, 1.0, 2.0, 1.0, 1.0, 3.0};
constexpr double kThrottleChange = 0.5;
constexpr double kSteeringChange = 0.01;
constexpr double kStopObjective = 1.5;
constexpr int kGradientSteps = 20;
constexpr double kRate = 0.4;
constexpr double kMomentum = 0.6;
/// The thrust has no slope at throttle 0.
constexpr double kLeastInput = 1e-12;

/// x, y, yaw, speed.
using State = Eigen::Vector4d;

struct Derivative {
  State of_time;
  Eigen::Matrix4d by_state{Eigen::Matrix4d::Zero()};
  State by_throttle{State::Zero()};
  State by_steering{State::Zero()};
};

Derivative derivative(const State& state, const vehicle::ActuatorInput& input,
                      const vehicle::IdentifiedVehicle& p) {
  const double speed = state[3];
  const double delta = input.steering + p.steering_offset;
  const double ratio = vehicle::path_speed_ratio(input.steering, p);
  const double course = state[2] + vehicle::identified_slip_rad(input.steering, p);
  const Point along{std::cos(course), std::sin(course)};
  const Point across{-along.y(), along.x()};
  const double thrust = p.thrust_offset_mps2 + p.thrust_per_volt * vehicle::kBatteryVoltage_v;

  Derivative d;
  d.of_time << ratio * speed * along, p.yaw_rate_gain_per_m * speed * delta,
      vehicle::identified_acceleration_mps2(speed, input.throttle, p);
  d.by_state.block<2, 1>(0, 2) = ratio * speed * across;
  d.by_state.block<2, 1>(0, 3) = ratio * along;
  d.by_state(2, 3) = p.yaw_rate_gain_per_m * delta;
  d.by_state(3, 3) = p.drag_per_s;
  d.by_throttle[3] =
      thrust * p.throttle_exponent * std::pow(std::abs(input.throttle), p.throttle_exponent - 1.0);
  d.by_steering.head<2>() =
      speed * (2.0 * p.path_speed_gain * p.path_speed_steering * delta * along +
               ratio * p.slip_gain_rad * across);
  d.by_steering[2] = p.yaw_rate_gain_per_m * speed;
  return d;
}

}  // namespace

void LabFollower::reset() {
  inputs_.setConstant(kLeastInput);
  momentum_.setConstant(kLeastInput);
}

void LabFollower::give(const vehicle::ActuatorInput& input) {
  std::shift_left(last_inputs_.begin(), last_inputs_.end(), 1);
  last_inputs_.back() = input;
}

Follower::Output LabFollower::decide(Nanoseconds t_now, const vehicle::VehicleMotion& estimate,
                                     const TrajectoryCommand* command) {
  if (!is_finite(estimate)) {
    reset();
    return {.input = {}, .status = FollowerStatus::kNoEstimate};
  }
  const vehicle::ActuatorInput stop = vehicle::stop_input(estimate.speed_mps);
  if (command == nullptr || !is_followable(command->points, t_now)) {
    reset();
    return {
        .input = stop,
        .status = command == nullptr ? FollowerStatus::kNoCommand : FollowerStatus::kNotFollowable};
  }
  vehicle::VehicleMotion start = estimate;
  for (const vehicle::ActuatorInput& input : last_inputs_) {
    start = vehicle::stepped(start, input, vehicle_);
  }
  Reference reference;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    reference[i] = sample(command->points, t_now + kFirstLook + i * kLookInterval)->position_m;
  }
  Objective last;
  for (int i = 0; i < kGradientSteps; ++i) {
    last = objective(start, reference);
    momentum_ = kMomentum * momentum_ - last.gradient;
    inputs_ = (inputs_ + kRate * momentum_).cwiseMax(-1.0).cwiseMin(1.0);
  }
  Follower::Output output{.input = {.throttle = inputs_[0], .steering = inputs_[kBlocks]},
                          .status = FollowerStatus::kFollowing};
  if (!(last.value < kStopObjective)) {
    reset();
    output = {.input = stop, .status = FollowerStatus::kTooFar};
  }
  return output;
}

LabFollower::Objective LabFollower::objective(const vehicle::VehicleMotion& start,
                                              const Reference& reference) const {
  Objective result;
  State state{start.pose.x_m, start.pose.y_m, start.pose.heading_rad, start.speed_mps};
  Eigen::Matrix<double, 4, 2 * kBlocks> by_inputs = Eigen::Matrix<double, 4, 2 * kBlocks>::Zero();
  for (int i = 0; i < kSteps; ++i) {
    const int block = i * kBlocks / kSteps;
    const Derivative d = derivative(
        state, {.throttle = inputs_[block], .steering = inputs_[kBlocks + block]}, vehicle_);
    by_inputs += kStep_s * d.by_state * by_inputs.eval();
    by_inputs.col(block) += kStep_s * d.by_throttle;
    by_inputs.col(kBlocks + block) += kStep_s * d.by_steering;
    state += kStep_s * d.of_time;
    const auto step = static_cast<std::size_t>(i);
    const double weight = kWeights[step] * kWeights[step];
    const Point error_m = state.head<2>() - reference[step];
    result.value += weight * error_m.squaredNorm();
    result.gradient += 2.0 * weight * by_inputs.topRows<2>().transpose() * error_m;
  }
  const auto add_changes = [&](int first, double before, double weight) {
    for (int i = first; i < first + kBlocks; ++i) {
      const double change = inputs_[i] - (i == first ? before : inputs_[i - 1]);
      result.value += weight * change * change;
      result.gradient[i] += 2.0 * weight * change;
      if (i > first) result.gradient[i - 1] -= 2.0 * weight * change;
    }
  };
  add_changes(0, last_inputs_.back().throttle, kThrottleChange);
  add_changes(kBlocks, last_inputs_.back().steering, kSteeringChange);
  return result;
}

}  // namespace hlc::tracking
