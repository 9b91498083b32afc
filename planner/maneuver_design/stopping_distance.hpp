#pragma once

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// l = s_x^2 + s_y^2 [m^2], with s measured from the maneuver's start: least for a motion that
/// stays near its start. For maneuvers into standstill: the emergency brake of a trim.
///
/// It depends on the position as J1 does (see Distance). Weaving shortens the way, starting to the
/// left or to the right: there are several local optima.
class StoppingDistance final : public RunningCost {
 public:
  [[nodiscard]] double value(const vehicle::StateVector& x, const vehicle::Input& u) const override;
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override;
  [[nodiscard]] bool depends_on_pose() const override { return true; }
  [[nodiscard]] bool has_many_optima() const override { return true; }
};

}  // namespace hlc::maneuver_design
