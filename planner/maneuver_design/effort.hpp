#pragma once

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// The paper's J2: l = u_v^2 + u_delta^2 [m^2/s^4 and rad^2/s^2 added up as they are, as in the
/// paper].
///
/// For a fixed duration T between fixed speeds and steering angles the optimum is constant input
/// (the integral of a square is least, for a given mean, if nothing varies), with J2 = (dv^2 +
/// ddelta^2) / T.
class Effort final : public RunningCost {
 public:
  [[nodiscard]] double value(const vehicle::StateVector& x, const vehicle::Input& u) const override;
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override;
};

}  // namespace hlc::maneuver_design
