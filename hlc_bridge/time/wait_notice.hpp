#pragma once

#include <algorithm>
#include <chrono>

namespace hlc {

/// When somebody who waits is to say for whom: after 2 s, then after twice the time of before, up
/// to every minute.
class WaitNotice {
 public:
  using Clock = std::chrono::steady_clock;

  explicit WaitNotice(Clock::time_point since = Clock::now()) : next_at_(since + pause_) {}

  /// True if it is time at `now`; the next time is later then.
  [[nodiscard]] bool is_due(Clock::time_point now = Clock::now()) {
    if (now < next_at_) return false;
    pause_ = std::min<Clock::duration>(2 * pause_, std::chrono::minutes{1});
    next_at_ = now + pause_;
    return true;
  }

 private:
  Clock::duration pause_{std::chrono::seconds{2}};
  Clock::time_point next_at_;
};

}  // namespace hlc
