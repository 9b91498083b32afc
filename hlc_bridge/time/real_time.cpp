#include "hlc_bridge/time/real_time.hpp"

#include <chrono>
#include <cstdlib>
#include <limits>

#include "hlc_bridge/time/wall_time.hpp"

namespace hlc::time {
namespace {

Nanoseconds system_time_now() {
  return nanoseconds(std::chrono::system_clock::now().time_since_epoch());
}

}  // namespace

SteadyRealTime::SteadyRealTime(Clock system, Clock steady)
    : system_{system}, steady_{steady}, offset_{offset_now()} {}

/// The thread can be interrupted between two readings: of several, the quickest one counts.
std::int64_t SteadyRealTime::offset_now() const {
  constexpr int kReadings = 5;
  std::int64_t offset = 0;
  Nanoseconds least = std::numeric_limits<Nanoseconds>::max();
  for (int i = 0; i < kReadings; ++i) {
    const Nanoseconds before = steady_();
    const Nanoseconds system = system_();
    const Nanoseconds duration = steady_() - before;
    if (duration >= least) continue;
    least = duration;
    offset = static_cast<std::int64_t>(system - before - duration / 2);
  }
  return offset;
}

const SteadyRealTime& steady_real_time() {
  static const SteadyRealTime kClock{system_time_now, wall_time_now};
  return kClock;
}

Nanoseconds real_time_now() {
  const SteadyRealTime& clock = steady_real_time();  // before the instant is taken
  return clock.at(wall_time_now());
}

std::optional<std::int64_t> SystemClockWatch::new_step(std::int64_t system_step) {
  const std::int64_t step = system_step - last_;
  if (std::abs(step) < kLeastStep) return std::nullopt;
  last_ = system_step;
  return step;
}

}  // namespace hlc::time
