#include "hlc_bridge/time/real_timer.hpp"

#include <stdexcept>
#include <string>

namespace hlc {

RealTick next_real_tick(Nanoseconds previous, Nanoseconds now, Nanoseconds period) {
  if (now < previous + 2 * period) {
    return {previous + period, 0};
  }
  const std::uint64_t periods = (now - previous) / period;
  return {previous + periods * period, periods - 1};
}

Nanoseconds first_real_tick(Nanoseconds now, Nanoseconds period, Nanoseconds offset) {
  if (now < offset) {
    return offset;
  }
  return ((now - offset) / period + 1) * period + offset;
}

RealTimer::RealTimer(Nanoseconds period, Nanoseconds offset) : period_{period}, previous_{} {
  if (offset >= period) {
    throw std::invalid_argument("timer: offset " + std::to_string(offset) +
                                " ns must be less than the period " + std::to_string(period) +
                                " ns");
  }
  previous_ = first_real_tick(real_time_now(), period, offset) - period;
}

std::optional<Nanoseconds> RealTimer::wait_next() {
  const RealTick tick = next_real_tick(previous_, real_time_now(), period_);
  std::unique_lock lock{mutex_};
  if (stopped_changed_.wait_until(lock, real_time_point(tick.time), [&] { return stopped_; })) {
    return std::nullopt;
  }
  previous_ = tick.time;
  missed_ += tick.missed;
  return tick.time;
}

void RealTimer::stop() {
  {
    const std::lock_guard lock{mutex_};
    stopped_ = true;
  }
  stopped_changed_.notify_all();
}

}  // namespace hlc
