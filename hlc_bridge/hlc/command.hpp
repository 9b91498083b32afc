#pragma once

#include <optional>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/controller/trajectory.hpp"
#include "planner/coordination/plan.hpp"

namespace hlc::high_level_controller {

/// The plan as the lab's timed trajectory command, in answer to the state list of `t_now` and valid
/// at once: points every `interval_s` (which divides the period) from one before t(step), standing
/// at the end, long enough for the vehicle's look-ahead as long as the copy is usable.
///
/// Without a plan: no points, which no vehicle follows, and valid only when no former command is
/// usable any longer, its copy included. So it answers the list, and changes nothing: whatever the
/// vehicle drives, it drives to its end.
[[nodiscard]] TrajectoryCommand command_of(VehicleId vehicle, const coordination::Plan* plan,
                                           StepIndex step, Nanoseconds t_now, Nanoseconds period,
                                           const vehicle::VehicleParameters& parameters,
                                           double interval_s = controller::kPointInterval_s);

/// The same command, usable after the first has expired: same create_stamp, valid_after later by
/// kCopyDelay.
[[nodiscard]] TrajectoryCommand copy_for_later(const TrajectoryCommand& command);

}  // namespace hlc::high_level_controller
