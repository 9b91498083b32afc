#pragma once

#include <chrono>

#include "hlc_bridge/time/thread_clock.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::apps {

/// The machine's clocks: wall time, and processor time of the calling thread.
[[nodiscard]] inline closed_loop::Clocks machine_clocks() {
  const auto wall_now = [] {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return static_cast<Nanoseconds>(std::chrono::nanoseconds(now).count());
  };
  return {.wall = wall_now, .cpu = time::thread_time_now};
}

}  // namespace hlc::apps
