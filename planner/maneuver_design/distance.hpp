#pragma once

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// The paper's J1: l = -(s_x^2 + s_y^2) [m^2], with s measured from the maneuver's start. Least for
/// a motion that gets far early.
///
/// It depends on the position, so a trim has no unit cost in it: the cost of a trim's step is the
/// integral from the step's own start (`trim_step_cost`). Its optimum is at the bound of u_v nearly
/// everywhere, and nearly flat in the steering: values are much more reproducible than end poses.
class Distance final : public RunningCost {
 public:
  [[nodiscard]] double value(const vehicle::StateVector& x, const vehicle::Input& u) const override;
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override;
  [[nodiscard]] bool depends_on_pose() const override { return true; }
};

}  // namespace hlc::maneuver_design
