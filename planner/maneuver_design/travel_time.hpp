#pragma once

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc {

/// l = 1, so J = T [s]. For maneuvers of free duration; with a fixed one every maneuver costs the
/// same.
class TravelTime final : public RunningCost {
 public:
  [[nodiscard]] double value(const StateVector& x, const Input& u) const override;
  [[nodiscard]] CostGradient gradient(const StateVector& x, const Input& u) const override;
};

}  // namespace hlc
