#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "planner/automaton/trim_id.hpp"
#include "planner/geometry/polygon.hpp"
#include "planner/geometry/pose.hpp"

/// What controllers publish in one control step, as plain data.
namespace hlc {

struct VehicleId {
  std::uint8_t value{};
  friend auto operator<=>(const VehicleId&, const VehicleId&) = default;
};

/// The lab numbers its vehicles 1 ... 30.
inline constexpr std::uint8_t kMaxVehicleId = 30;

/// Number k = t_now / period of the control step, from the time stamp and never from a count of
/// receipts, so equal numbers mean the same instant in every controller. t(k) = k * period.
struct StepIndex {
  std::uint64_t value{};
  friend auto operator<=>(const StepIndex&, const StepIndex&) = default;
};

/// Area that a vehicle occupies under one plan, step by step, in the map's frame; safety margin
/// included.
struct OccupiedAreas {
  StepIndex first;  ///< areas_m[i] holds during [t(first + i), t(first + i + 1)]
  std::vector<ConvexPolygon> areas_m;
  ConvexPolygon final_area_m;  ///< occupied after the last of them, for ever: plans end standing

  /// @pre step >= first
  [[nodiscard]] const ConvexPolygon& during(StepIndex step) const;
};

/// First message of step k: where I am and what I do if nothing new is agreed.
struct Traffic {
  VehicleId vehicle;
  StepIndex step;         ///< k
  Pose next_pose;         ///< planned pose at t(k+1): what is planned now starts there
  TrimId next_trim;       ///< trim then
  OccupiedAreas running;  ///< of the plan in force, first = k
  /// Contains everything that the vehicle can occupy from t(k) until t(k + 1 + horizon_steps),
  /// whatever it plans; safety margin included.
  ConvexPolygon reachable_area_m;
  /// Vehicles that the sender has not received for several steps. Who finds itself here keeps its
  /// running plan: the sender may soon take it for a standing obstacle (missing.hpp).
  std::vector<VehicleId> silent;
};

/// Second message of step k: what I have planned in this step, from t(k+1) on.
struct Prediction {
  VehicleId vehicle;
  StepIndex step;       ///< k
  bool is_new{};        ///< false: no new plan; `areas` are those of the running plan
  OccupiedAreas areas;  ///< first = k + 1
};

/// False for a message that no controller sends: an empty area (which would mean that the sender is
/// nowhere), or areas that do not begin at t(k) in traffic, at t(k+1) in a prediction. It counts as
/// not received.
[[nodiscard]] bool is_well_formed(const Traffic& traffic);
[[nodiscard]] bool is_well_formed(const Prediction& prediction);

/// Third message of step k: what came of it, as far as the sender can say by itself.
struct Outcome {
  VehicleId vehicle;
  StepIndex step;         ///< k
  bool wants_fallback{};  ///< commit rule `agreed`: the sender had to fall back
};

}  // namespace hlc
