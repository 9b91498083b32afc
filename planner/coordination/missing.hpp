#pragma once

#include "planner/coordination/messages.hpp"
#include "planner/geometry/footprint.hpp"

namespace hlc::coordination {

/// State of a vehicle in the state list.
struct MeasuredVehicle {
  VehicleId vehicle;
  Pose pose;  ///< heading_rad is the vehicle's yaw, not the planner's heading
  double speed_mps{};
  double age_s{};        ///< t(k) minus the stamp; negative in a list that comes late in its step
  double pose_lead_s{};  ///< the pose is that of the stamp plus this (LabLimits), >= 0
};

/// Older states are ignored.
inline constexpr double kMaxStateAge_s = 0.2;

/// Bounds on the motion of a silent vehicle.
struct MissingVehicleRules {
  /// No vehicle of the lab drives faster under its controller, but for one whose command came late:
  /// it may get beyond its reach by as much as it is behind its plan (limit in
  /// controller/plan_in_force.hpp).
  double max_speed_mps{};
  double circumradius_m{};          ///< of the footprint with its safety margin
  double standing_speed_mps{0.02};  ///< slower counts as standing
  Footprint footprint;
  double safety_margin_m{};
};

/// An octagon around the disc of everything that a vehicle measured at `measured` can occupy until
/// `horizon_s` after t(k): radius = max_speed (max(age, 0) + horizon) + circumradius. A lead does
/// not make it smaller: that of other software's vehicles is not known.
[[nodiscard]] ConvexPolygon reachable_disc(const MeasuredVehicle& measured, double horizon_s,
                                           const MissingVehicleRules& rules);

/// A vehicle from which nothing was received for this many steps in a row is listed in
/// Traffic::silent. A vehicle that is listed by a coupled vehicle commits to nothing new.
inline constexpr std::uint64_t kSilentSteps = 3;

/// A fresh state shows the vehicle standing.
[[nodiscard]] bool is_seen_standing(const MeasuredVehicle& measured,
                                    const MissingVehicleRules& rules);

/// State of a vehicle that publishes nothing.
struct Silence {
  StepIndex now;
  /// Last step in which it published, its process was there, or another vehicle received it.
  StepIndex last_sign_of_life;
  StepIndex last_not_standing;  ///< last step in which the state list did not show it standing
};

/// Whether a silent vehicle is a standing obstacle and no longer missing: its controller has gone,
/// every plan that it can have agreed to before has run out, and so has every plan that it was
/// driving when it was last seen moving: it stood in every list of the last horizon_steps + 1 +
/// kSilentSteps steps.
///
/// Silence alone does not suffice. A controller whose messages are not received may be alive,
/// commit to a plan with others, and drive off at any time; and two vehicles that do not receive
/// each other would both consider the other an obstacle, and drive off at once. So a vehicle whose
/// process is still present is missing for as long as it is silent, and the others avoid it.
///
/// A controller that has lost all others although it still commands its vehicle does not drive off:
/// as long as it receives nobody, and one that it has received before or whose process is present
/// does not stand for good, it plans nothing new from standstill (seeds 8592 and 20923 in
/// found_fault_test.cpp).
/// Assumption for what this leaves (two groups of controllers, each of which receives its own
/// members only; one for which all others stand for good; one that was started again and finds no
/// other's process): who shows no sign of life on the lab's network for this long cannot
/// command its vehicle either, since commands use that network.
[[nodiscard]] bool stands_for_good(const Silence& silence, std::size_t horizon_steps);

/// The footprint of a standing vehicle with its margin.
[[nodiscard]] ConvexPolygon standing_area(const MeasuredVehicle& measured,
                                          const MissingVehicleRules& rules);

}  // namespace hlc::coordination
