#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// How long a vehicle follows the last command that it has received. The lab's vehicle drops a
/// command 1 s after it became valid, so a controller sends copies that become valid later: the
/// vehicle can then drive the whole plan even if its controller dies at once.
namespace hlc::controller {

inline constexpr double kCommandLifetime_s = 1.0;
/// From one copy's time to become valid to that of the next one.
inline constexpr double kCopyDelay_s = 0.8;
/// A plan and one step more last at most so long: a minimal-risk stop, in which every vehicle
/// drives its plan to the end, is given this time before the run ends.
inline constexpr double kLongestPlan_s = 3.0;

/// How long a command with so many copies is followed. [s]
[[nodiscard]] constexpr double followed_s(std::size_t num_copies) {
  return kCommandLifetime_s + kCopyDelay_s * static_cast<double>(num_copies);
}

/// Copies of each command, so that a plan and one step more are followed; at least one.
[[nodiscard]] inline std::size_t num_copies(std::size_t horizon_steps, double step_s) {
  const double planned_s = static_cast<double>(horizon_steps + 1) * step_s;
  const double copies = std::ceil((planned_s - kCommandLifetime_s) / kCopyDelay_s - 1e-9);
  return static_cast<std::size_t>(std::max(1.0, copies));
}

/// From the step in which a plan is replaced, no command is sent for it: after so many steps more
/// no vehicle drives it. One step is for a state that is up to a step old.
[[nodiscard]] inline std::uint64_t drivable_steps(std::size_t horizon_steps, double step_s) {
  const double steps = std::ceil(followed_s(num_copies(horizon_steps, step_s)) / step_s - 1e-9);
  return static_cast<std::uint64_t>(steps) + 1;
}

}  // namespace hlc::controller
