#pragma once

#include <optional>

#include "planner/coordination/messages.hpp"

namespace hlc {

/// A vehicle as the state list shows it.
struct MeasuredVehicle {
  VehicleId vehicle;
  Pose pose;  ///< heading_rad is the vehicle's yaw, not the planner's heading
  double speed_mps{};
  double age_s{};  ///< t(k) minus the time at which the state was measured
};

/// What a silent vehicle may occupy.
struct MissingVehicleRules {
  double max_speed_mps{};           ///< no vehicle of the lab drives faster under its controller
  double circumradius_m{};          ///< of the footprint with its safety margin
  double standing_speed_mps{0.02};  ///< slower counts as standing
  double max_age_s{0.2};            ///< a state older than this shows nothing
  Footprint footprint;
  double safety_margin_m{};
};

/// An octagon around the disc of everything that a vehicle measured at `measured` can occupy until
/// `horizon_s` after t(k): radius = max_speed (age + horizon) + circumradius.
[[nodiscard]] ConvexPolygon reachable_disc(const MeasuredVehicle& measured, double horizon_s,
                                           const MissingVehicleRules& rules);

/// A vehicle that was not heard for this many steps in a row is listed in Traffic::silent.
inline constexpr std::uint64_t kSilentSteps = 3;

/// Whether a silent vehicle is a standing obstacle and no longer missing: a fresh state shows it
/// standing, and every plan that it can have agreed to has run out.
///
/// `last_heard` is the last step it spoke in. Messages may be lost in one direction only, so it may
/// have heard us and gone on planning; but from step last_heard + kSilentSteps on our traffic lists
/// it as silent, and who hears that (or hears nothing of us) agrees to nothing new near us. The
/// last plan it can have agreed to is that of step last_heard + kSilentSteps; it stands
/// `horizon_steps` + 1 steps later.
[[nodiscard]] bool stands_for_good(const MeasuredVehicle& measured, StepIndex now,
                                   StepIndex last_heard, std::size_t horizon_steps,
                                   const MissingVehicleRules& rules);

/// The footprint of a standing vehicle with its margin.
[[nodiscard]] ConvexPolygon standing_area(const MeasuredVehicle& measured,
                                          const MissingVehicleRules& rules);

}  // namespace hlc
