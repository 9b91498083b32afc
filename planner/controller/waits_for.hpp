#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "planner/coordination/messages.hpp"
#include "planner/coordination/plan.hpp"
#include "planner/coordination/report.hpp"

/// Which vehicles a standing vehicle waits for: the only place that decides on it. It explains a
/// step that is over, and changes no plan.
namespace hlc::controller {

/// What a vehicle would do if there were no other one: its optimum, from t(k+1) on.
struct MotionAlone {
  coordination::Plan plan;
  coordination::OccupiedAreas areas;
};

/// Another vehicle, as far as it limited planning in the step.
struct OtherVehicle {
  VehicleId vehicle;
  /// Areas that were to be kept clear of because of it, during the steps from t(k+1) on; as many
  /// as the horizon has steps.
  std::vector<std::vector<ConvexPolygon>> areas_m;
  /// It prevents any motion: it may be anywhere, does not receive this vehicle, voted against, or
  /// holds the next piece of this vehicle's road (authority.hpp).
  bool prevents_all{};
};

/// A step after its last phase. The functions are called only if their results are needed.
struct EndedStep {
  const coordination::Report& report;
  const coordination::Plan& in_force;  ///< during the step and from then on
  std::size_t horizon_steps{};
  bool is_disturbed{};  ///< it is off its plan, or not seen (DeviationCheck)
  std::function<std::optional<MotionAlone>()> alone;  ///< nothing: no plan is feasible
  std::function<std::vector<OtherVehicle>()> others;
};

/// The vehicle waits if
///
/// 1. it planned, or kept its plan for a reason that others can cause: `infeasible`, `missing`,
///    `conflict`, `neighbour`. Not if it is disturbed, late or off its route, if its plan cannot be
///    driven or if its search used up its budget;
/// 2. its plan in force stands: the same pose from t(k) to t(k+1+horizon);
/// 3. alone it would move: its optimum without all others leads away from where it begins. At its
///    goal, or where the boundary of its lanes leaves no way, it stands but does not wait;
/// 4. there is a vehicle that stops that motion: one whose areas meet those of the motion alone,
///    or that prevents any motion.
///
/// @return the vehicles of 4, by the first step in which they stop the motion, then by id; empty if
/// the vehicle does not wait
[[nodiscard]] std::vector<VehicleId> waits_for(const EndedStep& step);

}  // namespace hlc::controller
