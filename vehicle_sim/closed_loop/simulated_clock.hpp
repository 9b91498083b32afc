#pragma once

#include <cstdint>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::closed_loop {

/// Reading of a process's clock at a true time: the true time that has passed, at the clock's own
/// rate, from its own origin. A clock that is never stepped never goes back.
class SimulatedClock {
 public:
  /// @param shows      at true time `now`
  /// @param drift_ppb  it gains so many nanoseconds in a second; more than -1e9
  SimulatedClock(Nanoseconds now, Nanoseconds shows, std::int64_t drift_ppb)
      : since_(now), shows_(shows), drift_ppb_(drift_ppb) {}

  /// @pre now is not before the beginning or the last change
  [[nodiscard]] Nanoseconds at(Nanoseconds now) const {
    const auto passed = static_cast<std::int64_t>(now - since_);
    return shows_ + static_cast<Nanoseconds>(passed + gained(passed));
  }
  /// The first true time, not before `now`, at which it shows `local` or more.
  [[nodiscard]] Nanoseconds when(Nanoseconds local, Nanoseconds now) const {
    if (at(now) >= local) return now;
    const auto left = static_cast<std::int64_t>(local - shows_);
    const auto rate = static_cast<long double>(1'000'000'000 + drift_ppb_) / 1e9L;
    Nanoseconds then = since_ + static_cast<Nanoseconds>(static_cast<long double>(left) / rate);
    while (then > now && at(then - 1) >= local) --then;
    while (at(then) < local) ++then;
    return then;
  }

  /// From now on the clock shows `by` more.
  void step(Nanoseconds now, std::int64_t by) {
    restart(now);
    shows_ += static_cast<Nanoseconds>(by);
  }
  void set_drift(Nanoseconds now, std::int64_t drift_ppb) {
    restart(now);
    drift_ppb_ = drift_ppb;
  }
  [[nodiscard]] std::int64_t drift_ppb() const { return drift_ppb_; }

 private:
  [[nodiscard]] std::int64_t gained(std::int64_t passed) const {
    constexpr std::int64_t kSecond = 1'000'000'000;
    return passed / kSecond * drift_ppb_ + passed % kSecond * drift_ppb_ / kSecond;
  }
  void restart(Nanoseconds now) {
    shows_ = at(now);
    since_ = now;
  }

  Nanoseconds since_;
  Nanoseconds shows_;
  std::int64_t drift_ppb_;
};

}  // namespace hlc::closed_loop
