#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "planner/coordination/commit.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/coordination/plan.hpp"
#include "planner/coordination/report.hpp"

/// What a controller knows about the others' part in a step that is over. waits_for.hpp and
/// blocked_by.hpp decide on it; they change no plan.
namespace hlc::controller {

/// What a vehicle would do if there were no other one: its optimum, from t(k+1) on.
struct MotionAlone {
  coordination::Plan plan;
  coordination::OccupiedAreas areas;
};

/// Another vehicle, as far as it limited planning in the step.
struct OtherVehicle {
  VehicleId vehicle;
  /// Areas that planning was to keep clear of because of it, during the steps from t(k+1) on; as
  /// many as the horizon has steps.
  std::vector<std::vector<ConvexPolygon>> areas_m{};
  /// What the commit rule compares with the new plan; none: the search has kept clear of it.
  std::optional<coordination::CoupledAreas> compared{};
  bool is_out_of_contact{};  ///< it may be anywhere, or does not receive this vehicle
  bool is_opposed{};         ///< it voted against the new plan, or its vote was not received
  bool withholds_road{};     ///< it holds the next piece of this vehicle's road (authority.hpp)

  [[nodiscard]] bool prevents_all() const {
    return is_out_of_contact || is_opposed || withholds_road;
  }
};

/// A step after its last phase. The functions are called only if their results are needed.
struct EndedStep {
  const coordination::Report& report;
  const coordination::Plan& in_force;  ///< during the step and from then on
  /// Areas of the new plan that was published, from t(k+1) on; nullptr: there is none.
  const coordination::OccupiedAreas* new_plan{};
  std::size_t horizon_steps{};
  bool is_disturbed{};  ///< it is off its plan, or not seen (DeviationCheck)
  std::function<std::optional<MotionAlone>()> alone;  ///< nothing: no plan is feasible
  std::function<std::vector<OtherVehicle>()> others;

  [[nodiscard]] StepIndex next() const { return {report.step.value + 1}; }
};

/// The first step, from t(k+1) on, in which the other vehicle stops the motion: it prevents any, or
/// its areas meet those of the motion. None: it does not.
[[nodiscard]] std::optional<StepIndex> stops_in(const OtherVehicle& other,
                                                const coordination::OccupiedAreas& motion,
                                                const EndedStep& step);

}  // namespace hlc::controller
