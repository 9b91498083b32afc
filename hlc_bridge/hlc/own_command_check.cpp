#include "hlc_bridge/hlc/own_command_check.hpp"

#include <vector>

#include "planner/common/yaml_text.hpp"

namespace hlc::high_level_controller {
namespace {

/// Times relative to the first point.
std::vector<TimedPoint> timed_points(const TrajectoryCommand& command) {
  std::vector<TimedPoint> points;
  for (const TrajectoryPoint& point : command.points) {
    const auto after = static_cast<std::int64_t>(point.t - command.points.front().t);
    points.push_back({.time_s = 1e-9 * static_cast<double>(after),
                      .position_m = {point.x_m, point.y_m},
                      .velocity_mps = {point.vx_mps, point.vy_mps}});
  }
  return points;
}

}  // namespace

std::string validate_own_command(const TrajectoryCommand& command,
                                 const std::optional<vehicle::LabLimits>& limits) {
  if (command.points.empty()) return "";
  if (const auto found = vehicle::trajectory_fault(timed_points(command), limits)) {
    return vehicle::to_text(*found, limits.value_or(vehicle::LabLimits{})) + ", " +
           shortest_text(found->time_s) + " s after the first point";
  }
  const auto after_valid_s = [&command](const TrajectoryPoint& point) {
    return shortest_text(
        1e-9 * static_cast<double>(static_cast<std::int64_t>(point.t - command.valid_after_stamp)));
  };
  if (command.points.front().t >= command.valid_after_stamp) {
    return "the first point is " + after_valid_s(command.points.front()) +
           " s after valid_after, must be before it";
  }
  constexpr Nanoseconds kLeast = kCommandLifetime + kLookAhead;
  if (command.points.back().t < command.valid_after_stamp + kLeast) {
    return "the last point is " + after_valid_s(command.points.back()) +
           " s after valid_after, must be >= " + shortest_text(1e-9 * kLeast) +
           " s: the vehicle's look-ahead";
  }
  return "";
}

TrajectoryCommand republished(TrajectoryCommand command, Nanoseconds t_now,
                              std::size_t num_copies) {
  command.create_stamp = t_now;
  command.valid_after_stamp = t_now;
  if (command.points.empty()) return command;
  const Nanoseconds until = t_now + followed_ns(num_copies) + kLookAhead;
  if (command.points.back().t < until) {
    command.points.push_back(command.points.back());
    command.points.back().t = until;
  }
  return command;
}

}  // namespace hlc::high_level_controller
