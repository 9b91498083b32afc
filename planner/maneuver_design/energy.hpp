#pragma once

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc {

/// l = max(u_v, 0) v [W/kg]: power per mass that the drive puts in; braking gives nothing back.
///
/// With v >= 0 no maneuver of given end speeds needs less than max(0, (v_T^2 - v_0^2) / 2), and
/// each one that never accelerates more than it must (speed monotonic) needs just that: the optimum
/// is far from unique, and a sum with another criterion chooses among the cheapest.
///
/// At u_v = 0 there is a kink: the gradient there is that from the side of braking.
class Energy final : public RunningCost {
 public:
  [[nodiscard]] double value(const StateVector& x, const Input& u) const override;
  [[nodiscard]] CostGradient gradient(const StateVector& x, const Input& u) const override;
};

}  // namespace hlc
