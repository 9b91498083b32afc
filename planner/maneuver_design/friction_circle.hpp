#pragma once

#include "planner/maneuver_design/path_constraint.hpp"

namespace hlc::maneuver_design {

/// g = (u_v^2 + a_lat^2) / a_max^2 - 1, with a_lat = v psi' (see lateral_acceleration): the tyres'
/// limit, longitudinal and lateral together.
class FrictionCircle final : public PathConstraint {
 public:
  /// @pre acceleration_max_mps2 > 0
  FrictionCircle(double acceleration_max_mps2, const vehicle::VehicleParameters& vehicle)
      : acceleration_max_mps2_(acceleration_max_mps2), vehicle_(vehicle) {}

  [[nodiscard]] double value(const vehicle::StateVector& x, const vehicle::Input& u) const override;
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override;
  [[nodiscard]] std::string name() const override;

 private:
  double acceleration_max_mps2_;
  vehicle::VehicleParameters vehicle_;
};

}  // namespace hlc::maneuver_design
