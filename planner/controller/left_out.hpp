#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "planner/controller/prepared_subgraph.hpp"
#include "planner/coordination/ids.hpp"
#include "planner/coordination/plan.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::controller {

/// Limits that a step's problem is posed without, to see what they cost (Controller::plan_without).
struct LeftOut {
  std::vector<VehicleId> vehicles{};  ///< nothing keeps clear of them
  bool boundary{};                    ///< of the drivable area
  bool authority{};                   ///< its end: the bar, and where it cuts the reference
  bool obstacles{};                   ///< that are no vehicles
  [[nodiscard]] bool holds(VehicleId vehicle) const {
    return std::ranges::find(vehicles, vehicle) != vehicles.end();
  }
};

/// What planning finds without some limits.
struct PlanWithout {
  std::optional<coordination::Plan> plan;  ///< none: there is none
  double cost_m2{};                        ///< of the plan, in `problem`
  search::HorizonProblem problem;          ///< the one that was searched last
};

/// Cost of the positions of a plan's steps from t(next) on in a problem that begins there [m^2]:
/// its whole cost but for the criteria of its maneuvers.
[[nodiscard]] inline double position_cost_m2(const coordination::Plan& plan, StepIndex next,
                                             const search::HorizonProblem& problem) {
  double sum_m2 = 0.0;
  for (std::size_t j = 0; j < problem.horizon_steps(); ++j) {
    sum_m2 += problem.position_cost_m2(j, plan.pose_at({next.value + j + 1}).position_m());
  }
  return sum_m2;
}

}  // namespace hlc::controller
