#include "hlc_bridge/middleware/command_check.hpp"

#include <algorithm>
#include <cmath>

namespace hlc::middleware {
namespace {

bool all_finite(const TrajectoryCommand& command) {
  return std::all_of(command.points.begin(), command.points.end(),
                     [](const TrajectoryPoint& point) {
                       return std::isfinite(point.x_m) && std::isfinite(point.y_m) &&
                              std::isfinite(point.vx_mps) && std::isfinite(point.vy_mps);
                     });
}

bool times_increase(const TrajectoryCommand& command) {
  return std::adjacent_find(command.points.begin(), command.points.end(),
                            [](const TrajectoryPoint& a, const TrajectoryPoint& b) {
                              return a.t >= b.t;
                            }) == command.points.end();
}

}  // namespace

const char* to_string(CommandFault fault) {
  switch (fault) {
    case CommandFault::kNotAssigned:
      return "vehicle is not assigned to this middleware";
    case CommandFault::kNotFinite:
      return "a coordinate or velocity is not finite";
    case CommandFault::kTimesNotIncreasing:
      return "times of the points do not increase strictly";
    case CommandFault::kFromTheFuture:
      return "create_stamp lies in the future";
    case CommandFault::kMissedPeriod:
      return "missed the current period";
    case CommandFault::kTooFewPoints:
      return "fewer than 3 points";
    case CommandFault::kNoPointBefore:
      return "no point before valid_after";
    case CommandFault::kNoPointAfter:
      return "no point at or after valid_after";
  }
  return "?";
}

CommandVerdict check_header(std::uint8_t vehicle_id, Nanoseconds create_stamp, Nanoseconds t_now,
                            Nanoseconds newest_list, std::span<const std::uint8_t> vehicle_ids) {
  CommandVerdict verdict;
  if (std::find(vehicle_ids.begin(), vehicle_ids.end(), vehicle_id) == vehicle_ids.end()) {
    verdict.forward = false;
    verdict.faults.push_back(CommandFault::kNotAssigned);
  }
  if (create_stamp > t_now) {
    verdict.faults.push_back(CommandFault::kFromTheFuture);
  }
  if (create_stamp < newest_list) {
    verdict.faults.push_back(CommandFault::kMissedPeriod);
  }
  return verdict;
}

CommandVerdict check_command(const TrajectoryCommand& command, Nanoseconds t_now,
                             Nanoseconds newest_list, std::span<const std::uint8_t> vehicle_ids) {
  CommandVerdict verdict =
      check_header(command.vehicle_id, command.create_stamp, t_now, newest_list, vehicle_ids);
  const auto keep_back = [&](CommandFault fault) {
    verdict.forward = false;
    verdict.faults.push_back(fault);
  };
  if (!all_finite(command)) {
    keep_back(CommandFault::kNotFinite);
  }
  if (!times_increase(command)) {
    keep_back(CommandFault::kTimesNotIncreasing);
  }
  if (command.points.empty()) {
    return verdict;
  }
  if (command.points.size() < 3) {
    verdict.faults.push_back(CommandFault::kTooFewPoints);
  }
  const auto before = [&](const TrajectoryPoint& p) { return p.t < command.valid_after_stamp; };
  if (std::none_of(command.points.begin(), command.points.end(), before)) {
    verdict.faults.push_back(CommandFault::kNoPointBefore);
  }
  if (std::all_of(command.points.begin(), command.points.end(), before)) {
    verdict.faults.push_back(CommandFault::kNoPointAfter);
  }
  return verdict;
}

}  // namespace hlc::middleware
