#pragma once

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// Factors of the three squares, so that their units can be added up.
struct ComfortWeights {
  double longitudinal{1.0};
  double lateral{1.0};
  double steering_rate{1.0};
};

/// l = w_long u_v^2 + w_lat a_lat^2 + w_rate u_delta^2, with a_lat = v psi' of the single-track
/// model (see lateral_acceleration). All weights 1, in units of m and s, is the criterion named
/// "comfort".
class Comfort final : public RunningCost {
 public:
  explicit Comfort(const vehicle::VehicleParameters& vehicle, const ComfortWeights& weights = {})
      : vehicle_(vehicle), weights_(weights) {}

  [[nodiscard]] double value(const vehicle::StateVector& x, const vehicle::Input& u) const override;
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override;

 private:
  vehicle::VehicleParameters vehicle_;
  ComfortWeights weights_;
};

}  // namespace hlc::maneuver_design
