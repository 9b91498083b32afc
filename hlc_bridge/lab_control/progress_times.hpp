#pragma once

#include <optional>
#include <utility>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::lab_control {

/// Times of the progress lines: every `interval` of wall time, but not in the first second, since
/// most starts and short runs have ended by then.
class ProgressTimes {
 public:
  static constexpr Nanoseconds kQuietTime = kNanosecondsPerSecond;

  explicit ProgressTimes(Nanoseconds interval) : interval_(interval) {}

  /// True if it is time at `now`; the next time is an interval later then. The first call begins
  /// the quiet time.
  [[nodiscard]] bool is_due(Nanoseconds now) {
    if (!std::exchange(has_begun_, true)) next_ = now + kQuietTime;
    if (now < next_) return false;
    next_ = now + interval_;
    return true;
  }
  /// Nothing before the first call.
  [[nodiscard]] std::optional<Nanoseconds> next() const {
    return has_begun_ ? std::optional(next_) : std::nullopt;
  }

 private:
  Nanoseconds interval_;
  Nanoseconds next_{};
  bool has_begun_{};
};

}  // namespace hlc::lab_control
