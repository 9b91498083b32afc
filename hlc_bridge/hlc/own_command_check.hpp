#pragma once

#include <optional>
#include <string>

#include "hlc_bridge/hlc/command.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc {

/// What is wrong with a command that a controller is about to send, in words; empty if nothing is.
///
/// * Every number is finite, times increase strictly, the last velocity is 0 (trajectory_fault).
/// * A point lies before valid_after.
/// * The last point is not before valid_after + kCommandLifetime + kLookAhead: as long as the
///   command is usable at all, the vehicle finds all that it looks at. The lab's rule asks for
///   now + delay + period + 360 ms; what is beyond that is for missed periods.
/// * With limits: positions in the lab's area, velocities that fit them, acceleration and
/// curvature.
///
/// A command without points tells the vehicle to stand, and is good.
[[nodiscard]] std::string validate_own_command(const TrajectoryCommand& command,
                                               const std::optional<LabLimits>& limits);

/// A command that was good, as the answer to the list of `t_now`: created and valid then; standing
/// on at its end as long as it takes to be good again.
[[nodiscard]] TrajectoryCommand republished(TrajectoryCommand command, Nanoseconds t_now);

}  // namespace hlc
