#pragma once

#include <array>

#include <Eigen/Core>

#include "vehicle_sim/tracking/follower.hpp"

namespace hlc::tracking {

/// The on-board controller of the lab's vehicle: model predictive control by a few gradient steps,
/// with the lab's figures (wire contract, 6.4).
///
/// Decision variables are throttle and steering in three blocks of two steps; the model
/// (planner/vehicle/identified_motion.hpp) is integrated by explicit Euler with dt = 50 ms, from
/// the state predicted with the last three inputs for t_now + 60 ms. With the reference r at
/// t_now + 110 ms + i dt, i = 0 ... 5,
///
///     J = sum_i w_i^2 |p_i - r_i|^2 + 0.5 sum (throttle change)^2 + 0.01 sum (steering change)^2
///     w = 1, 1, 2, 1, 1, 3
///
/// Each tick makes 20 steps of gradient descent with momentum, m <- 0.6 m - dJ/du, u <- u + 0.4 m,
/// u clipped to [-1, 1], from the last tick's result. J >= 1.5 (some 0.3 m from the reference):
/// stop law.
///
/// It predicts three of the four inputs that are queued (kInputDelayTicks), weighs positions only,
/// looks 0.3 s ahead and does not converge where the reference starts or stops: there the vehicle
/// leaves its reference by some cm. That is the lab's vehicle, not a fault of this model.
///
/// Simplification: after ticks without a command it begins as at the start; the lab's keeps its
/// last inputs.
class LabFollower {
 public:
  explicit LabFollower(const vehicle::IdentifiedVehicle& vehicle) : vehicle_(vehicle) { reset(); }

  /// The input to give at `t_now`, as Follower::decide: to be called once per tick.
  [[nodiscard]] Follower::Output decide(Nanoseconds t_now, const vehicle::VehicleMotion& estimate,
                                        const TrajectoryCommand* command);

  /// The input given at this tick, from any source.
  void give(const vehicle::ActuatorInput& input);

 private:
  static constexpr int kSteps = 6;
  static constexpr int kBlocks = 3;
  /// Throttle of all blocks, then steering.
  using Inputs = Eigen::Matrix<double, 2 * kBlocks, 1>;
  using Reference = std::array<Point, kSteps>;

  struct Objective {
    double value{};
    Inputs gradient{Inputs::Zero()};
  };

  void reset();
  [[nodiscard]] Objective objective(const vehicle::VehicleMotion& start,
                                    const Reference& reference) const;

  vehicle::IdentifiedVehicle vehicle_;
  Inputs inputs_;
  Inputs momentum_;
  std::array<vehicle::ActuatorInput, 3> last_inputs_{};  ///< oldest first
};

}  // namespace hlc::tracking
