#pragma once

#include "planner/maneuver_design/path_constraint.hpp"

namespace hlc::maneuver_design {

/// g = (+-course rate / curvature_max - sqrt(v^2 + creep^2)) / (1 m/s), see path_curvature.hpp:
/// bounds the curvature of the driven path to the left (+) or to the right (-). One side is one
/// constraint, because both together would not be smooth in the inputs.
class CurvatureLimit final : public PathConstraint {
 public:
  enum class Side { kLeft, kRight };

  /// @pre curvature_max_per_m > 0
  CurvatureLimit(Side side, double curvature_max_per_m, const vehicle::VehicleParameters& vehicle)
      : side_(side), curvature_max_per_m_(curvature_max_per_m), vehicle_(vehicle) {}

  [[nodiscard]] double value(const vehicle::StateVector& x, const vehicle::Input& u) const override;
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override;
  [[nodiscard]] std::string name() const override;

 private:
  [[nodiscard]] double factor() const {
    return (side_ == Side::kLeft ? 1.0 : -1.0) / curvature_max_per_m_;
  }

  Side side_;
  double curvature_max_per_m_;
  vehicle::VehicleParameters vehicle_;
};

}  // namespace hlc::maneuver_design
