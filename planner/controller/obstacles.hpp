#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "planner/coordination/messages.hpp"
#include "planner/coordination/missing.hpp"

namespace hlc {

/// What is known of a coupled vehicle when planning begins. Not owned.
struct CoupledVehicle {
  const Traffic* traffic{};
  const Prediction* prediction{};  ///< of a predecessor, if it was received; else nullptr
  bool is_predecessor{};           ///< it plans before
};

/// What planning keeps clear of during one step because of one coupled vehicle: adds its areas. A
/// rule is one function; it has to keep clear of what the commit rule takes for granted
/// (commit.hpp).
/// @param step  from t(k+1) on
using CoupledObstacleRule = void (*)(const CoupledVehicle& other, StepIndex step,
                                     std::vector<ConvexPolygon>& areas_m);

/// Goes with the commit rule `strict`: what it drives now, and the new plan of a predecessor; of a
/// predecessor that was not received everything that it can reach.
void old_and_new_plans(const CoupledVehicle& other, StepIndex step,
                       std::vector<ConvexPolygon>& areas_m);
/// Goes with the commit rule `agreed`: of a predecessor what it predicted or, not received,
/// everything that it can reach; of others what they occupy standing, if they stand.
void predictions_and_standing_successors(const CoupledVehicle& other, StepIndex step,
                                         std::vector<ConvexPolygon>& areas_m);

/// A vehicle that was not received. Not owned.
struct MissingVehicle {
  const MeasuredVehicle* measured{};
  bool stands_for_good{};  ///< Neighbours::stands_for_good
};

/// Areas to keep clear of in each of the steps t(k+1) ... t(k+1+horizon):
/// HorizonProblem::obstacles_m. Depends on nothing but its arguments. Of a missing vehicle they are
/// its reachable disc, or its footprint if it stands for good.
/// @param now  k
[[nodiscard]] std::vector<std::vector<ConvexPolygon>> obstacles_m(
    std::span<const CoupledVehicle> coupled, CoupledObstacleRule coupled_rule,
    std::span<const MissingVehicle> missing, const MissingVehicleRules& missing_rules,
    StepIndex now, std::size_t horizon_steps, double step_s);

}  // namespace hlc
