#pragma once

#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::middleware {

/// Faults of a controller's command (wire contract, 5.5). The lab's middleware forwards every
/// command and only logs; ours holds back what no vehicle can drive.
enum class CommandFault : std::uint8_t {
  kNotAssigned,         ///< vehicle_id is not this middleware's                        (kept back)
  kNotFinite,           ///< a coordinate or velocity is not a finite number            (kept back)
  kTimesNotIncreasing,  ///< the points' times do not increase strictly                 (kept back)
  kFromTheFuture,       ///< create_stamp is later than the clock
  kMissedPeriod,        ///< create_stamp is before the list of the current period
  kTooFewPoints,        ///< fewer than 3 points; none at all command nothing, and are no fault
  kNoPointBefore,       ///< no point strictly before valid_after_stamp
  kNoPointAfter,        ///< no point at or after valid_after_stamp
};

[[nodiscard]] const char* to_string(CommandFault fault);

struct CommandVerdict {
  bool forward{true};
  std::vector<CommandFault> faults;  ///< empty for a command without fault
};

/// Checks vehicle and time of a command of any kind.
/// @param t_now       time of arrival
/// @param newest_list t_now of the last published list
/// @param vehicle_ids the vehicles of the middleware
[[nodiscard]] CommandVerdict check_header(std::uint8_t vehicle_id, Nanoseconds create_stamp,
                                          Nanoseconds t_now, Nanoseconds newest_list,
                                          std::span<const std::uint8_t> vehicle_ids);

/// The same, and the trajectory.
[[nodiscard]] CommandVerdict check_command(const TrajectoryCommand& command, Nanoseconds t_now,
                                           Nanoseconds newest_list,
                                           std::span<const std::uint8_t> vehicle_ids);

}  // namespace hlc::middleware
