#pragma once

#include <string>
#include <vector>

#include "planner/maneuver_design/maneuver_problem.hpp"

namespace hlc::maneuver_design {

/// Necessary conditions from the bounds on inputs and states, checked before solving: each input
/// must be able to make its change in the given time, and the trims must lie within the bounds.
struct Feasibility {
  std::string reason;            ///< names every violated bound; empty if none is
  double shortest_duration_s{};  ///< see ManeuverSolution
};

[[nodiscard]] Feasibility feasibility_of(const ManeuverProblem& problem);

/// How far a motion violates each kind of constraint, 0 if it holds.
struct ConstraintResiduals {
  double end_speed_mps{};
  double end_steering_rad{};
  double acceleration_mps2{};
  double steering_rate_radps{};
  double speed_mps{};
  double steering_rad{};
  double path{};        ///< the largest g_i; g has no unit
  double cost_bound{};  ///< of J_i <= max_i, relative to CostBound::scale
};

/// How far a motion violates the constraints of a problem.
[[nodiscard]] ConstraintResiduals residuals_of(const ManeuverProblem& problem,
                                               const std::vector<vehicle::Input>& inputs,
                                               const std::vector<vehicle::State>& states,
                                               double duration_s);

/// Tolerances: 1e-9 relative to each bound, 1e-8 for g, which has none.
inline constexpr double kFeasibilityTolerance = 1e-9;
inline constexpr double kPathTolerance = 1e-8;

[[nodiscard]] bool within_tolerance(const ConstraintResiduals& residuals,
                                    const vehicle::VehicleLimits& limits);

}  // namespace hlc::maneuver_design
