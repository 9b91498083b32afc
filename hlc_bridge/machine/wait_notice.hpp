#pragma once

#include <algorithm>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::machine {

/// When somebody who waits logs for whom: 2 s after the wait began, then after twice the time of
/// before, up to every minute. All times are wall time.
class WaitNotice {
 public:
  explicit WaitNotice(Nanoseconds since) : next_(since + pause_) {}

  /// True if it is time at `now`; the next time is later then.
  [[nodiscard]] bool is_due(Nanoseconds now) {
    if (now < next_) return false;
    pause_ = std::min(2 * pause_, 60 * kNanosecondsPerSecond);
    next_ = now + pause_;
    return true;
  }
  [[nodiscard]] Nanoseconds next() const { return next_; }

 private:
  Nanoseconds pause_{2 * kNanosecondsPerSecond};
  Nanoseconds next_;
};

}  // namespace hlc::machine
