#pragma once

#include <ctime>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::time {

/// Processor time of the calling thread [ns]: its own computation, without preemption.
[[nodiscard]] inline Nanoseconds thread_time_now() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return Nanoseconds{1'000'000'000} * static_cast<Nanoseconds>(now.tv_sec) +
         static_cast<Nanoseconds>(now.tv_nsec);
}

}  // namespace hlc::time
