#include "hlc_bridge/time/logical_timer.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace hlc {

LogicalTimer::LogicalTimer(Nanoseconds period, Nanoseconds offset,
                           std::function<void(Nanoseconds)> send_ready,
                           std::chrono::milliseconds repeat, std::chrono::milliseconds patience)
    : period_{period},
      wanted_{offset},
      send_ready_{std::move(send_ready)},
      repeat_{repeat},
      patience_{patience} {
  if (offset >= period) {
    throw std::invalid_argument("timer: offset " + std::to_string(offset) +
                                " ns must be less than the period " + std::to_string(period) +
                                " ns");
  }
}

std::optional<Nanoseconds> LogicalTimer::wait_next() {
  std::unique_lock lock{mutex_};
  const Nanoseconds wanted = wanted_;
  while (!released_ && !stopped_) {
    lock.unlock();
    send_ready_(wanted);
    lock.lock();
    changed_.wait_for(lock, repeat_, [&] { return released_ || stopped_; });
    if (!released_ && !stopped_ && std::chrono::steady_clock::now() - last_trigger_ >= patience_) {
      has_given_up_ = stopped_ = true;
    }
  }
  if (stopped_) {
    return std::nullopt;
  }
  released_ = false;
  wanted_ = wanted + period_;
  return wanted;
}

void LogicalTimer::stop() {
  {
    const std::lock_guard lock{mutex_};
    stopped_ = true;
  }
  changed_.notify_all();
}

bool LogicalTimer::has_given_up() const {
  const std::lock_guard lock{mutex_};
  return has_given_up_;
}

void LogicalTimer::on_trigger(Nanoseconds next_start) {
  if (next_start == kStopSymbol) {
    stop();
    return;
  }
  {
    const std::lock_guard lock{mutex_};
    last_trigger_ = std::chrono::steady_clock::now();
    if (next_start != wanted_) {
      return;  // for other timers; waking a thread would cost time in every tick
    }
    released_ = true;
  }
  changed_.notify_all();
}

}  // namespace hlc
