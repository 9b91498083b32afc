#pragma once

#include <chrono>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::time {

[[nodiscard]] constexpr Nanoseconds nanoseconds(std::chrono::nanoseconds time) {
  return static_cast<Nanoseconds>(time.count());
}

/// Wall time: of a clock that never goes back, with an arbitrary origin
/// (std::chrono::steady_clock).
[[nodiscard]] inline Nanoseconds wall_time_now() {
  return nanoseconds(std::chrono::steady_clock::now().time_since_epoch());
}

/// The same instant as a deadline for Signal::wait_until.
[[nodiscard]] inline std::chrono::steady_clock::time_point wall_time_point(Nanoseconds time) {
  return std::chrono::steady_clock::time_point{
      std::chrono::nanoseconds{static_cast<std::int64_t>(time)}};
}

}  // namespace hlc::time
