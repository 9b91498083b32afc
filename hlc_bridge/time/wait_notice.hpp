#pragma once

#include <algorithm>
#include <chrono>

namespace hlc {

/// When a waiting process is to log what it waits for: after 2 s, then at doubling intervals, up to
/// a minute.
class WaitNotice {
 public:
  using Clock = std::chrono::steady_clock;

  explicit WaitNotice(Clock::time_point since = Clock::now()) : next_at_(since + pause_) {}

  /// True if a notice is due at `now`; schedules the next one.
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
