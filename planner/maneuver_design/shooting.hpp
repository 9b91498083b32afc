#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// A motion with intervals of equal length of constant input, and its cost.
struct Shot {
  std::vector<vehicle::State> states;  ///< at the interval bounds: one more than there are inputs
  double cost{};                       ///< J
  /// dJ/du of each interval, u = (u_v, u_delta); empty if not asked for.
  std::vector<Eigen::Vector2d> gradient;
  double duration_gradient{};  ///< dJ/dT with the inputs kept; 0 if not asked for
};

enum class WithGradient { kNo, kYes };

/// Simulates the model from `start` and adds up the cost: one step of the classical Runge-Kutta
/// method per interval, for the cost as for the states (J is a sixth state, J' = l).
/// The gradient is that of exactly this discretised cost, not an approximation: the derivative is
/// propagated backwards through every stage of every step (the discrete adjoint), at about the cost
/// of two more simulations.
///
/// @pre inputs is not empty, duration_s > 0
[[nodiscard]] Shot shoot(const vehicle::State& start, const std::vector<vehicle::Input>& inputs,
                         double duration_s, const RunningCost& cost,
                         const vehicle::VehicleParameters& vehicle, WithGradient with_gradient);

}  // namespace hlc::maneuver_design
