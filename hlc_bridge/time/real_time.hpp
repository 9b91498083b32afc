#pragma once

#include <chrono>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::time {

/// Now, nanoseconds since the Unix epoch (CLOCK_REALTIME): the time of runs in real time.
[[nodiscard]] Nanoseconds real_time_now();

/// The same instant as a deadline for Signal::wait_until.
[[nodiscard]] std::chrono::system_clock::time_point real_time_point(Nanoseconds time);

}  // namespace hlc::time
