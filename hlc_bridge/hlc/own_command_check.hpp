#pragma once

#include <optional>
#include <string>

#include "hlc_bridge/hlc/command.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc::high_level_controller {

/// Error in a command that a controller is about to send, in words; empty: none.
///
/// * Every number is finite, times increase strictly, the last velocity is 0 (trajectory_fault).
/// * A point lies before valid_after.
/// * The last point is not before valid_after + kCommandLifetime + kLookAhead: as long as the
///   command is usable, the vehicle finds every point that its look-ahead needs. The lab's rule
///   asks for now + delay + period + 360 ms; the rest is for missed periods.
/// * With limits: positions in the lab's area, velocities that fit them, acceleration and
/// curvature.
///
/// A command without points commands the vehicle to stand, and is good.
[[nodiscard]] std::string validate_own_command(const TrajectoryCommand& command,
                                               const std::optional<vehicle::LabLimits>& limits);

/// A good command again, as the answer to the list of `t_now`: created and valid then; extended at
/// its end by standing until it is good again, its copies included.
[[nodiscard]] TrajectoryCommand republished(TrajectoryCommand command, Nanoseconds t_now,
                                            std::size_t num_copies = 1);

}  // namespace hlc::high_level_controller
