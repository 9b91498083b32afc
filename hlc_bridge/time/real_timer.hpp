#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "hlc_bridge/time/real_time.hpp"
#include "hlc_bridge/time/timer.hpp"

namespace hlc {

/// The tick that a real timer delivers at time `now` after the tick `previous`.
struct RealTick {
  Nanoseconds time{};      ///< in the future: wait for it; now or before: deliver it at once
  std::uint64_t missed{};  ///< ticks between `previous` and it that are skipped
};

/// The latest tick not after `now` if it comes after `previous` (a tick late by less than a period
/// is delivered late, older ones are skipped), otherwise previous + period. @pre period > 0
[[nodiscard]] RealTick next_real_tick(Nanoseconds previous, Nanoseconds now, Nanoseconds period);

/// The first k * period + offset after `now`. @pre period > 0, offset < period
[[nodiscard]] Nanoseconds first_real_tick(Nanoseconds now, Nanoseconds period, Nanoseconds offset);

/// Ticks by the computer's clock. The first tick is the first after construction.
///
/// Ticks never repeat or go back. If the computer's clock is set back, the timer waits until the
/// clock has caught up.
class RealTimer : public Timer {
 public:
  /// Throws std::invalid_argument unless 0 <= offset < period.
  RealTimer(Nanoseconds period, Nanoseconds offset);

  [[nodiscard]] std::optional<Nanoseconds> wait_next() override;
  void stop() override;

  /// Ticks skipped so far because the caller returned too late. For the thread that calls
  /// wait_next.
  [[nodiscard]] std::uint64_t missed() const { return missed_; }

 private:
  Nanoseconds period_;
  Nanoseconds previous_;
  std::uint64_t missed_{};
  std::mutex mutex_;
  std::condition_variable stopped_changed_;
  bool stopped_{};
};

}  // namespace hlc
