#pragma once

#include <ctime>

#include "vehicle_sim/campaign/experiment.hpp"

namespace hlc {

/// [ns] of a clock of the system.
[[nodiscard]] inline Nanoseconds time_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return Nanoseconds{1'000'000'000} * static_cast<Nanoseconds>(now.tv_sec) +
         static_cast<Nanoseconds>(now.tv_nsec);
}

/// The machine's: wall time, and processor time of the thread that asks.
[[nodiscard]] inline Clocks machine_clocks() {
  return {.wall = [] { return time_of(CLOCK_MONOTONIC); },
          .cpu = [] { return time_of(CLOCK_THREAD_CPUTIME_ID); }};
}

}  // namespace hlc
