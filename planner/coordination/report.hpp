#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/coordination/certificate.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/coordination/waiting.hpp"

namespace hlc::coordination {

/// What a controller does in a step.
enum class StepStatus : std::uint8_t {
  kStandby,          ///< before the start: stands, waits
  kPlanned,          ///< the new plan is in force
  kFallback,         ///< the previous plan, shifted by one step, stays in force
  kMinimalRiskStop,  ///< the running plan is driven to its end, no new plan
};

enum class FallbackReason : std::uint8_t {
  kNone,
  /// The search found that no plan exists, or, with right of way, its plan ends askew in the lane
  /// or beyond the authority, and none gets far that ends nearer (planner/controller/plan_end.hpp).
  kInfeasible,
  /// The search exhausted its expansions before it found a plan; or, for a standing vehicle, the
  /// search of a way into its lanes (lane_entry.hpp) did so when it departed.
  kBudget,
  /// A coupled vehicle was silent and its reachable set leaves no room; or a standing vehicle
  /// receives nobody (missing.hpp).
  kMissing,
  kConflict,    ///< the new plan meets another vehicle's new or running plan
  kNeighbour,   ///< commit rule `agreed`: a vehicle of the same component fell back
  kDeviation,   ///< the own vehicle is too far from its planned pose, or not seen
  kLate,        ///< a deadline of the step had passed
  kUndrivable,  ///< the new plan or its command is beyond what the vehicle can follow
  /// The vehicle stands where it fits no route (status `standby`), or from where it cannot get onto
  /// its route (lane_entry.hpp).
  kOffRoute,
};

/// How good the plan is that the search found in this step, whether it came into force or not.
enum class PlanQuality : std::uint8_t {
  kNone,     ///< no plan was found or none was searched
  kOptimal,  ///< no plan costs less
  kBudget,   ///< the search stopped early; the optimum is at most `gap_m2` cheaper
  /// The same with the cost-to-go of 2022, which may overestimate.
  kUnproven,
};

[[nodiscard]] const char* to_string(StepStatus status);
[[nodiscard]] const char* to_string(FallbackReason reason);
[[nodiscard]] const char* to_string(PlanQuality quality);

/// "vehicle 3", "vehicles 3, 5".
[[nodiscard]] std::string vehicles_text(const std::vector<VehicleId>& vehicles);

/// Road that a vehicle holds with right of way (LaneClaim), as a step ends.
struct HeldRoad {
  std::uint32_t route{};  ///< index in the run's conflict map
  double place_m{};       ///< arc length of the planned place at t(k), in [0, length)
  double ahead_m{};       ///< from there to the end of its authority, >= 0
  friend bool operator==(const HeldRoad&, const HeldRoad&) = default;
};

/// Result of one step of one vehicle. Nothing in it depends on a clock.
struct Report {
  VehicleId vehicle;
  StepIndex step;  ///< k
  StepStatus status{StepStatus::kStandby};
  FallbackReason reason{FallbackReason::kNone};
  Pose planned_pose;  ///< of the plan in force at t(k)
  TrimId planned_trim;
  /// Label of the same plan's maneuver during [t(k), t(k+1)], independent of the new plan; empty:
  /// there is no plan.
  std::string maneuver;
  /// Name of the subgraph on which the plan of this step was found; without a plan, of the subgraph
  /// that the controller plans on.
  std::string subgraph;
  /// Of the plan found in this step, for the reference of the search that found it: for a vehicle
  /// that is held up with right of way, one that ends where it gets to, or nearer; 0 if none.
  double cost_m2{};
  PlanQuality quality{PlanQuality::kNone};
  double gap_m2{};  ///< of that plan: its cost minus a lower bound of every plan's; or 0
  /// Whatever new plans the other vehicles make, none of this vehicle costs less [m^2]
  /// (joint_gap.hpp), for the same reference. None: the new plan did not come into force, or it was
  /// found on the subgraph before a switch.
  std::optional<double> bound_m2{};
  std::uint64_t generated{};  ///< vertices
  std::uint64_t expanded{};
  std::uint32_t level{};           ///< computation level, 0 plans first
  std::vector<VehicleId> coupled;  ///< vehicles coupled with this one
  std::vector<VehicleId> missing;  ///< vehicles that were silent
  /// footprint_deviation_m, at the time of the measured state; for a vehicle that fits no route,
  /// how far its footprint reaches beyond the lanes of the nearest.
  double deviation_m{};
  Waiting waiting{};  ///< for which vehicles it stands, and since when
  /// Step since which the vehicle has been at the end of its route, where it stood in that step;
  /// none: it has not arrived there, or its route has no end.
  std::optional<StepIndex> arrived_since{};
  /// Vehicles that kept the new plan from coming into force (planner/controller/blocked_by.hpp),
  /// sorted; empty: none, or it was for the vehicle's own reasons.
  std::vector<VehicleId> blocked_by;
  /// Plan::maneuvers_from(k) of the plan in force as the step ends; empty: there is none.
  std::vector<PlannedManeuver> plan;
  std::optional<HeldRoad> held;                    ///< none: no right of way, or no plan
  std::shared_ptr<const Certificate> certificate;  ///< of that plan; null: on standby
};

}  // namespace hlc::coordination
