#pragma once

#include <optional>

#include "hlc_bridge/messages/messages.hpp"

/// The instants of a run, and which message belongs to which instant. All processes derive them
/// from these functions and the time stamps alone, never from the order of arrivals.
///
///     vehicle ticks   t = i * 20 ms
///     state lists     t = k * P + 1 ns      k is the number of the control step, P the period
namespace hlc {

/// Lists are published this much after the step's begin, so that the vehicle tick at the same
/// instant is over.
inline constexpr Nanoseconds kListOffset = 1;

inline constexpr Nanoseconds kNanosecondsPerSecond = 1'000'000'000;
inline constexpr Nanoseconds kNanosecondsPerMillisecond = 1'000'000;

/// No process waits longer than this (wall time) for a message of another one that seems to be
/// alive.
inline constexpr Nanoseconds kMessageTimeout = 10 * kNanosecondsPerSecond;

/// In real time, after the lab control has died: controllers make a minimal-risk stop for this long
/// and leave, then the middlewares leave, then the vehicles, which stand by then. (In logical time
/// the clock stands still without it, and all processes leave at once.)
inline constexpr Nanoseconds kControllerStays = 3 * kNanosecondsPerSecond;
inline constexpr Nanoseconds kMiddlewareStays = 4 * kNanosecondsPerSecond;
inline constexpr Nanoseconds kVehicleStays = 5 * kNanosecondsPerSecond;

/// Number k of the control step that `t` lies in: t(k) <= t < t(k + 1), t(k) = k * period.
[[nodiscard]] constexpr std::uint64_t step_at(Nanoseconds t, Nanoseconds period) {
  return t / period;
}

/// The last list published strictly before `t`; nothing before the very first one. A vehicle
/// computes the tick at `t` with the answer to this list.
[[nodiscard]] constexpr std::optional<Nanoseconds> last_list_before(Nanoseconds t,
                                                                    Nanoseconds period) {
  if (t <= kListOffset) {
    return std::nullopt;
  }
  return (t - 1 - kListOffset) / period * period + kListOffset;
}

/// create_stamp of the newest vehicle state that is valid at `t_now`: states are created at vehicle
/// ticks and valid 60 ms later. Nothing while no state can be valid yet.
[[nodiscard]] constexpr std::optional<Nanoseconds> newest_valid_state_stamp(Nanoseconds t_now) {
  if (t_now <= kStateDelay) {
    return std::nullopt;
  }
  return (t_now - kStateDelay) / kVehiclePeriod * kVehiclePeriod;
}

/// The first instant k * period + offset that is not before `t`. @pre offset < period
[[nodiscard]] constexpr Nanoseconds next_on_grid(Nanoseconds t, Nanoseconds period,
                                                 Nanoseconds offset) {
  if (t <= offset) {
    return offset;
  }
  return (t - offset + period - 1) / period * period + offset;
}

}  // namespace hlc
