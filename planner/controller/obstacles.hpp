#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "planner/coordination/messages.hpp"
#include "planner/coordination/missing.hpp"

namespace hlc::controller {

/// What is known of a coupled vehicle when planning begins. Not owned.
struct CoupledVehicle {
  const coordination::Traffic* traffic{};
  const coordination::Prediction*
      prediction{};       ///< of a predecessor, if received; otherwise nullptr
  bool is_predecessor{};  ///< it plans before
};

/// Areas that planning keeps clear of during one step because of one coupled vehicle. A rule is one
/// function that adds them; it has to keep clear of everything that the commit rule relies on
/// (commit.hpp).
/// @param step  from t(k+1) on
using CoupledObstacleRule = void (*)(const CoupledVehicle& other, StepIndex step,
                                     std::vector<ConvexPolygon>& areas_m);

/// Matches the commit rule `strict`: the running plan, and the new plan of a predecessor; of a
/// predecessor that was not received everything that it can reach.
void old_and_new_plans(const CoupledVehicle& other, StepIndex step,
                       std::vector<ConvexPolygon>& areas_m);
/// Matches the commit rule `agreed`: of a predecessor its prediction or, if not received,
/// everything that it can reach; of others their area at standstill, if they stand.
void predictions_and_standing_successors(const CoupledVehicle& other, StepIndex step,
                                         std::vector<ConvexPolygon>& areas_m);

/// What remains of them if the new plans of predecessors are left out: under `strict` the running
/// plan, under `agreed` nothing, since a standing vehicle may plan to drive off, too.
void old_plans(const CoupledVehicle& other, StepIndex step, std::vector<ConvexPolygon>& areas_m);
void no_plans(const CoupledVehicle& other, StepIndex step, std::vector<ConvexPolygon>& areas_m);

/// A vehicle without received traffic. Not owned.
struct MissingVehicle {
  const coordination::MeasuredVehicle* measured{};
  bool stands_for_good{};  ///< Neighbours::stands_for_good
};

/// Areas to keep clear of in each of the steps t(k+1) ... t(k+1+horizon):
/// HorizonProblem::obstacles_m. Depends on its arguments only. For a missing vehicle they are its
/// reachable disc, or its footprint if it stands for good.
/// @param now  k
[[nodiscard]] std::vector<std::vector<ConvexPolygon>> obstacles_m(
    std::span<const CoupledVehicle> coupled, CoupledObstacleRule coupled_rule,
    std::span<const MissingVehicle> missing, const coordination::MissingVehicleRules& missing_rules,
    StepIndex now, std::size_t horizon_steps, double step_s);

}  // namespace hlc::controller
