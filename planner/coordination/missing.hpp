#pragma once

#include <optional>

#include "planner/coordination/messages.hpp"
#include "planner/geometry/footprint.hpp"

namespace hlc {

/// A vehicle as the state list shows it.
struct MeasuredVehicle {
  VehicleId vehicle;
  Pose pose;  ///< heading_rad is the vehicle's yaw, not the planner's heading
  double speed_mps{};
  double age_s{};  ///< t(k) minus the time at which the state was measured
};

/// A state older than this shows nothing.
inline constexpr double kMaxStateAge_s = 0.2;

/// What a silent vehicle may occupy.
struct MissingVehicleRules {
  double max_speed_mps{};           ///< no vehicle of the lab drives faster under its controller
  double circumradius_m{};          ///< of the footprint with its safety margin
  double standing_speed_mps{0.02};  ///< slower counts as standing
  Footprint footprint;
  double safety_margin_m{};
};

/// An octagon around the disc of everything that a vehicle measured at `measured` can occupy until
/// `horizon_s` after t(k): radius = max_speed (age + horizon) + circumradius.
[[nodiscard]] ConvexPolygon reachable_disc(const MeasuredVehicle& measured, double horizon_s,
                                           const MissingVehicleRules& rules);

/// A vehicle that was not received for this many steps in a row is listed in Traffic::silent. Who
/// finds itself listed by a vehicle that it is coupled with agrees to nothing new.
inline constexpr std::uint64_t kSilentSteps = 3;

/// A fresh state shows the vehicle standing.
[[nodiscard]] bool is_seen_standing(const MeasuredVehicle& measured,
                                    const MissingVehicleRules& rules);

/// What is remembered of a vehicle that publishes nothing.
struct Silence {
  StepIndex now;
  StepIndex last_sign_of_life;  ///< last step in which it published or its process was there
  StepIndex last_not_standing;  ///< last step in which the state list did not show it standing
};

/// Whether a silent vehicle is a standing obstacle and no longer missing: its controller has gone,
/// every plan that it can have agreed to before has run out, and so has every plan that it was
/// driving when it was last seen moving: it stood in every list of the last horizon_steps + 1 +
/// kSilentSteps steps.
///
/// Silence alone does not suffice. A controller that is not received may live, agree to something
/// with others, and begin to drive at any time; and of two that do not receive each other each
/// would take the other for an obstacle, and both would drive off at once. So a vehicle whose
/// process is still there is missing for as long as it is silent, and the others keep out of its
/// way. Assumption: who neither is received on the controllers' network nor shows any sign of life
/// on the lab's for this long cannot command its vehicle either, since commands take the lab's
/// network.
[[nodiscard]] bool stands_for_good(const Silence& silence, std::size_t horizon_steps);

/// The footprint of a standing vehicle with its margin.
[[nodiscard]] ConvexPolygon standing_area(const MeasuredVehicle& measured,
                                          const MissingVehicleRules& rules);

}  // namespace hlc
