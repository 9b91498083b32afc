#pragma once

#include <compare>
#include <cstddef>
#include <string>
#include <vector>

#include "planner/automaton/criterion.hpp"
#include "planner/automaton/trim_id.hpp"
#include "planner/geometry/polygon.hpp"
#include "planner/vehicle/identified_vehicle.hpp"
#include "planner/vehicle/single_track.hpp"

namespace hlc::automaton {

/// Constant speed and steering (paper, Section 2): u = 0.
struct Trim {
  double speed_mps{};
  double steering_rad{};

  /// The vehicle can stay here forever: speed 0.
  [[nodiscard]] bool is_equilibrium() const { return speed_mps == 0.0; }
  friend bool operator==(const Trim&, const Trim&) = default;
};

/// Label of every trim's self-loop.
inline const std::string kSelfLoopLabel = "trim";

/// Motion of one step from one trim to another, or of a trim itself: its self-loop, the trim driven
/// for one step, for every label, or a maneuver back to it that is optimal for a label (SelfLoops).
///
/// All quantities are in the frame of the start pose (start at the origin, heading 0).
struct Maneuver {
  TrimId from;
  TrimId to;
  std::string label;  ///< criterion that it is optimal for ("J2"); "trim" for a self-loop
  double duration_s{};
  std::vector<vehicle::Input> inputs;  ///< N intervals of equal length of constant input
  /// N + 1 states at the interval bounds, the first at the origin
  std::vector<vehicle::State> states;
  Pose displacement;  ///< pose of states.back()
  /// Convex area that contains the footprint, grown by the safety margin, at every time of the
  /// motion, for the planned heading and for the heading of a vehicle with the identified slip on
  /// the same path.
  ConvexPolygon swept_area_m;
  /// Convex area that contains the footprint itself (planned heading, no margin) at every time: for
  /// the test against lane bounds.
  ConvexPolygon lane_area_m;
  /// Of all criteria, whatever the label. For a trim's self-loop in J1, which depends on the
  /// position: the integral from the self-loop's start.
  std::vector<CriterionValue> criteria;

  [[nodiscard]] bool is_self_loop() const { return label == kSelfLoopLabel; }
};

/// All trims and maneuvers of a vehicle, for one step length. Immutable once built.
struct UniversalAutomaton {
  vehicle::VehicleParameters vehicle;
  vehicle::VehicleLimits limits;
  vehicle::IdentifiedVehicle identified;
  double step_s{0.2};
  std::vector<Trim> trims;
  /// Unit costs l(x, 0) of each trim [per second], of the criteria that have one: those that do not
  /// depend on the pose, hence neither J1 nor stopping_distance. One entry per trim, or none at
  /// all.
  std::vector<std::vector<CriterionValue>> unit_costs;
  std::vector<Maneuver> maneuvers;

  /// nullptr if the automaton does not hold that edge. A trim's self-loop is found under every
  /// label that the automaton holds no step from the trim to itself of.
  [[nodiscard]] const Maneuver* find(TrimId from, TrimId to, const std::string& label) const;
};

/// Largest speed along the motion, at its ends and between them: a maneuver may outrun both its
/// trims. Exact, because the speed is linear between two states.
[[nodiscard]] double top_speed_mps(const Maneuver& maneuver);

/// The same over all its maneuvers, enabled or not.
[[nodiscard]] double top_speed_mps(const UniversalAutomaton& automaton);

/// Angle from a planned heading to the yaw at which the identified vehicle drives the same path:
/// course = heading + beta(delta) = yaw + slip(curvature(delta)), so yaw - heading = beta(delta) -
/// slip [rad].
[[nodiscard]] double yaw_minus_heading_rad(double steering_rad,
                                           const vehicle::VehicleParameters& vehicle,
                                           const vehicle::IdentifiedVehicle& identified);

/// True if the identified vehicle has less than 20 % of its steering left on this trim's path, or
/// cannot drive it at all: it can hardly correct an error there. Of the paper's trims this holds
/// for those at 0.60 and 0.48 rad; they take 0.9998 and 0.83 of the steering on the left, 1.09 and
/// 0.90 on the right.
[[nodiscard]] bool is_at_steering_limit(const Trim& trim, const vehicle::VehicleParameters& vehicle,
                                        const vehicle::IdentifiedVehicle& identified);

/// State of the motion at `time_s` in [0, duration], in the maneuver's frame: the model integrated
/// from the last interval bound before (exact arc for a trim's self-loop).
[[nodiscard]] vehicle::State state_at(const Maneuver& maneuver, double time_s,
                                      const vehicle::VehicleParameters& vehicle);

}  // namespace hlc::automaton
