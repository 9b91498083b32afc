#pragma once

#include "planner/coordination/missing.hpp"
#include "planner/coordination/plan.hpp"

namespace hlc::controller {

/// Pose of a vehicle at a time within a plan: t(step) + time_s, 0 <= time_s < one step.
struct SeenAt {
  StepIndex step;
  double time_s{};
  Pose pose;  ///< heading_rad is the yaw
};

/// Where and when the state list of step `now` shows a vehicle: at the pose's stamp plus its lead.
/// A time outside [0, t(now + 1)) is taken for the nearest one inside.
[[nodiscard]] SeenAt seen_at(const coordination::MeasuredVehicle& measured, StepIndex now,
                             double step_s);

/// A predicted instant of a drive.
struct PredictedInstant {
  StepIndex step;
  vehicle::State planned;
  Pose pose;  ///< of the vehicle, heading_rad is the yaw
};

/// The drive of a vehicle that follows `plan`, from its measured pose until t(until): tick by tick
/// of 20 ms with the identified model (planner/vehicle/identified_motion.hpp), the course aimed at
/// the next planned position plus a correction of the error across it (5 /s), the steering limited
/// by its actuator (vehicle::actuated), the speed as planned plus a correction of the error along
/// it. Where the plan stands the steering is kept, and the vehicle still catches up with its plan.
/// Instants at which a step ends are given twice: as the end of that step and as the begin of the
/// next. @pre plan.first() <= seen.step
[[nodiscard]] std::vector<PredictedInstant> predicted_drive(
    const coordination::Plan& plan, const SeenAt& seen, StepIndex until,
    const automaton::UniversalAutomaton& automaton);

/// Areas of `plan` from t(from) on that contain the vehicle's real drive.
///
/// A maneuver's swept area contains a vehicle whose deviation from its plan is at most the safety
/// margin. That suffices wherever the vehicle has steering left for corrections. It does not where
/// the plan turns faster than the vehicle can: the paper's trim of -0.60 rad needs 4.315 1/m where
/// the identified vehicle turns with 3.960 1/m at most, and a start from standstill straight into
/// +-0.60 rad turns the course by 0.41 rad where the vehicle can turn 0.36 rad. Such an error grows
/// as long as the steering is at its limit (to some 60 mm) and vanishes afterwards; no follower can
/// avoid it.
///
/// So the drive is predicted. In a step in which the predicted footprint deviates from the planned
/// one (footprint_deviation_m) by more than `tolerated_m`, the area becomes the hull of the swept
/// area and of all its predicted footprints grown by the safety margin; so does the final one, from
/// the pose at the end. Then the last area becomes its hull with the final one, too: plans are
/// compared until the horizon ends (coordination/commit.hpp), so whatever is free of the last area
/// must be free of the vehicle at rest. All other areas stay bitwise the same.
///
/// Assumption for the claim that the areas contain the vehicle: prediction and drive differ by no
/// more than margin - tolerated_m (tests/vehicle_sim/campaign measures it in whole closed loops).
/// @pre plan.first() <= seen.step <= from
[[nodiscard]] coordination::OccupiedAreas areas_with_drift(
    const coordination::Plan& plan, StepIndex from, const SeenAt& seen,
    const automaton::UniversalAutomaton& automaton, double tolerated_m);

}  // namespace hlc::controller
