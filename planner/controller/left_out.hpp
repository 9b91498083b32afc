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
  search::HorizonProblem problem;          ///< of the plan; without one, the last that was searched
};

}  // namespace hlc::controller
