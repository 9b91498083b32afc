#pragma once

#include <cstddef>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/controller/trajectory.hpp"
#include "planner/coordination/plan.hpp"

namespace hlc::high_level_controller {

/// The plan as the lab's timed trajectory command, in answer to the state list of `t_now` and valid
/// at once: points every `interval_s` (which divides the period) from one before t(step), standing
/// at the end, long enough for the vehicle's look-ahead as long as the last copy is usable.
///
/// Without a plan: no points, which no vehicle follows, and valid only when no former command is
/// usable any longer, its copies included. So it answers the list, and changes nothing: whatever
/// the vehicle drives, it drives to its end.
/// @param num_copies  of each command (planner/controller/command_time.hpp)
[[nodiscard]] TrajectoryCommand command_of(VehicleId vehicle, const coordination::Plan* plan,
                                           StepIndex step, Nanoseconds t_now, Nanoseconds period,
                                           const vehicle::VehicleParameters& parameters,
                                           double interval_s = controller::kPointInterval_s,
                                           std::size_t num_copies = 1);

/// The same command, usable after the first has expired: same create_stamp, valid_after later by
/// `number` times kCopyDelay.
[[nodiscard]] TrajectoryCommand copy_for_later(const TrajectoryCommand& command,
                                               std::size_t number = 1);

/// How long a command with so many copies is followed.
[[nodiscard]] Nanoseconds followed_ns(std::size_t num_copies);

}  // namespace hlc::high_level_controller
