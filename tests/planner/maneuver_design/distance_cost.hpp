#pragma once

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc {

/// The paper's J1, l = -(s_x^2 + s_y^2) [m^2]: a cost that depends on the state and is far from
/// convex, to try gradients and solver with.
class DistanceCost final : public RunningCost {
 public:
  [[nodiscard]] double value(const StateVector& x, const Input& /*u*/) const override {
    return -x.head<2>().squaredNorm();
  }
  [[nodiscard]] CostGradient gradient(const StateVector& x, const Input& /*u*/) const override {
    CostGradient gradient;
    gradient.state.head<2>() = -2.0 * x.head<2>();
    return gradient;
  }
};

}  // namespace hlc
