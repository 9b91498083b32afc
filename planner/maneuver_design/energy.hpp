#pragma once

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

inline constexpr double kCoastingBand_mps2 = 0.02;

/// l = max(u_v, 0) v [W/kg]: power per mass of the drive; braking does not recuperate.
///
/// With v >= 0 no maneuver of given end speeds needs less than max(0, (v_T^2 - v_0^2) / 2), and
/// each one that never accelerates more than necessary (speed monotonic) needs just that: the
/// optimum is far from unique, and a sum with another criterion chooses among the cheapest.
///
/// max(u_v, 0) has a kink where the vehicle coasts, and coasting is often best in a sum with
/// another criterion or under a bound on one; such an optimum satisfies no smooth condition. So
/// between 0 and kCoastingBand_mps2 a cubic joins the two straight parts, s^2 (2 - s) with s = u_v
/// / band: below max(u_v, 0) by at most 0.15 times the band, and equal to it elsewhere.
class Energy final : public RunningCost {
 public:
  [[nodiscard]] double value(const vehicle::StateVector& x, const vehicle::Input& u) const override;
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override;
};

}  // namespace hlc::maneuver_design
