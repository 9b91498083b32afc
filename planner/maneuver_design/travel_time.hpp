#pragma once

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// l = 1, so J = T [s]. For maneuvers of free duration; with a fixed one every maneuver costs the
/// same.
class TravelTime final : public RunningCost {
 public:
  [[nodiscard]] double value(const vehicle::StateVector& x, const vehicle::Input& u) const override;
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override;
};

}  // namespace hlc::maneuver_design
