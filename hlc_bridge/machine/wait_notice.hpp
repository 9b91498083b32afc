#pragma once

#include <algorithm>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::machine {

/// When a waiting process logs what it waits for: 2 s after the wait began, then at doubling
/// intervals, up to a minute or the given pause. All times are wall time.
class WaitNotice {
 public:
  explicit WaitNotice(Nanoseconds since, Nanoseconds longest = 60 * kNanosecondsPerSecond)
      : longest_(longest), next_(since + pause_) {}

  /// True if a notice is due at `now`; schedules the next one.
  [[nodiscard]] bool is_due(Nanoseconds now) {
    if (now < next_) return false;
    pause_ = std::min(2 * pause_, longest_);
    next_ = now + pause_;
    return true;
  }
  [[nodiscard]] Nanoseconds next() const { return next_; }

 private:
  Nanoseconds longest_;
  Nanoseconds pause_{2 * kNanosecondsPerSecond};
  Nanoseconds next_;
};

}  // namespace hlc::machine
