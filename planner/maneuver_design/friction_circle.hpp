#pragma once

#include "planner/maneuver_design/path_constraint.hpp"

namespace hlc {

/// g = (u_v^2 + a_lat^2) / a_max^2 - 1, with a_lat = v psi' (see lateral_acceleration): the tyres'
/// limit, longitudinal and lateral together.
class FrictionCircle final : public PathConstraint {
 public:
  /// @pre acceleration_max_mps2 > 0
  FrictionCircle(double acceleration_max_mps2, const VehicleParameters& vehicle)
      : acceleration_max_mps2_(acceleration_max_mps2), vehicle_(vehicle) {}

  [[nodiscard]] double value(const StateVector& x, const Input& u) const override;
  [[nodiscard]] CostGradient gradient(const StateVector& x, const Input& u) const override;
  [[nodiscard]] std::string name() const override;

 private:
  double acceleration_max_mps2_;
  VehicleParameters vehicle_;
};

}  // namespace hlc
