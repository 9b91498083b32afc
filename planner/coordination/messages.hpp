#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/trim_id.hpp"
#include "planner/coordination/ids.hpp"
#include "planner/coordination/planning_input.hpp"
#include "planner/geometry/polygon.hpp"
#include "planner/geometry/pose.hpp"

/// What controllers publish in one control step, as plain data.
namespace hlc::coordination {

/// Area that a vehicle occupies under one plan, step by step, in the map's frame; safety margin
/// included.
struct OccupiedAreas {
  StepIndex first;  ///< areas_m[i] holds during [t(first + i), t(first + i + 1)]
  std::vector<ConvexPolygon> areas_m;
  ConvexPolygon final_area_m;  ///< occupied after the last of them, forever: plans end standing

  /// @pre step >= first
  [[nodiscard]] const ConvexPolygon& during(StepIndex step) const;
  friend bool operator==(const OccupiedAreas&, const OccupiedAreas&) = default;
};

/// Part of a plan: the maneuver (or self-loop) of one step.
struct PlannedManeuver {
  TrimId to;  ///< trim in which it ends
  std::string label;
  friend bool operator==(const PlannedManeuver&, const PlannedManeuver&) = default;
};

/// Which part of a route shared with others a vehicle holds: from its place to the end of its
/// authority, beyond which no plan of it leads (right_of_way/grant.hpp).
struct LaneClaim {
  std::uint32_t route{};  ///< index in the run's conflict map
  double place_m{};       ///< arc length of the planned place at t(k), in [0, length)
  double ahead_m{};       ///< from there to the end, >= 0
  std::uint32_t
      waiting_steps{};  ///< control steps for which the vehicle has stood and declined nothing
  friend bool operator==(const LaneClaim&, const LaneClaim&) = default;
};

/// First message of step k: planned pose, and areas of the plan in force.
struct Traffic {
  VehicleId vehicle;
  StepIndex step;         ///< k
  Pose next_pose;         ///< planned pose at t(k+1): the new plan starts there
  TrimId next_trim;       ///< trim then
  OccupiedAreas running;  ///< of the plan in force, first = k
  /// Contains everything that the vehicle can occupy from t(k) until t(k + 1 + horizon_steps), for
  /// any plan; safety margin included.
  ConvexPolygon reachable_area_m;
  /// Vehicles from which the sender received nothing for several steps. A vehicle that is listed
  /// keeps its running plan: the sender may soon consider it a standing obstacle (missing.hpp).
  std::vector<VehicleId> silent;
  std::uint32_t standing_steps{};  ///< control steps for which the plan in force has stood
  /// The vehicle on the reference points of the new plan, whatever the others do, at t(k+2),
  /// t(k+3), ...; safety margin included. Empty: no priorities compare them, or it has no place on
  /// its route.
  std::vector<ConvexPolygon> reference_areas_m{};
  /// Place at t(k), authority as of the end of the last step. Absent: the run has no right of way.
  std::optional<LaneClaim> claim{};
  /// With which the receivers can plan for the sender. Absent: they cannot; they need its
  /// prediction.
  std::optional<PlanningInput> planning{};
};

/// Second message of step k: the plan of this step, from t(k+1) on.
struct Prediction {
  VehicleId vehicle;
  StepIndex step;       ///< k
  bool is_new{};        ///< false: no new plan; `areas` are those of the running plan
  OccupiedAreas areas;  ///< first = k + 1
  /// Of the plan that the sender would drive if those that plan after it made room
  /// (controller/making_room.hpp). Absent: it desires nothing else, or the rule knows no such
  /// plans.
  std::optional<OccupiedAreas> desired{};
  friend bool operator==(const Prediction&, const Prediction&) = default;
};

/// False for an invalid message: an empty area (the sender would be nowhere), or areas that do not
/// begin at t(k) in traffic, at t(k+1) in a prediction, or a claim that is no place. Such a message
/// counts as not received.
[[nodiscard]] bool is_well_formed(const Traffic& traffic);
[[nodiscard]] bool is_well_formed(const Prediction& prediction);

/// With two rounds: what the sender planned from.
struct PlanDigests {
  std::uint64_t inputs{};          ///< of all traffic that it planned from, its own included
  std::uint64_t plan{};            ///< of the prediction that it has computed for itself
  bool is_prediction_published{};  ///< for receivers that could not compute it
  friend bool operator==(const PlanDigests&, const PlanDigests&) = default;
};

/// Last message of step k: its result, as far as the sender alone knows it.
struct Outcome {
  VehicleId vehicle;
  StepIndex step;         ///< k
  bool wants_fallback{};  ///< commit rule `agreed`: the sender had to fall back
  /// Instead of a prediction, for receivers that have computed it themselves (digest.hpp).
  std::optional<PlanDigests> digests{};
};

[[nodiscard]] inline bool is_well_formed(const Outcome& /*outcome*/) { return true; }

}  // namespace hlc::coordination
