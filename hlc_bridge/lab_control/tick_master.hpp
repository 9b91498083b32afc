#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::lab_control {

/// Logical time: releases ticks to timers that wait for them (wire contract, 5.3).
///
/// Every timer *requests* the tick that it wants next. The smallest request T is *released* once
/// every timer has answered the ticks before, that is, requests a tick later than all released
/// ones. So ticks are released in order of time, and each one only when all work of earlier ticks
/// is done. Dropped timers are not waited for. Plain data: no clock, no lock.
class TickMaster {
 public:
  explicit TickMaster(const std::vector<std::string>& timers);

  /// Request of the timer for `tick`; true if it is new. Unknown timers are ignored.
  bool request(const std::string& timer, Nanoseconds tick);
  /// The timer has not yet requested anything, as at the start.
  void forget(const std::string& timer);
  /// The timer is gone for good.
  void drop(const std::string& timer);

  /// The timers that the next release waits for: those that have requested nothing beyond the last
  /// one.
  [[nodiscard]] std::vector<std::string> unanswered() const;
  /// The tick that can be released now; nothing while one is unanswered or no timer is left.
  [[nodiscard]] std::optional<Nanoseconds> releasable() const;
  /// Releases it. @pre releasable()
  Nanoseconds release();

  /// True if the timer waits for the tick released last: it may have missed the trigger.
  [[nodiscard]] bool waits_for_released(const std::string& timer, Nanoseconds tick) const;
  [[nodiscard]] std::optional<Nanoseconds> released() const { return released_; }
  /// No timer is left.
  [[nodiscard]] bool empty() const { return requests_.empty(); }

 private:
  [[nodiscard]] bool has_answered(const std::optional<Nanoseconds>& request) const {
    return request && (!released_ || *request > *released_);
  }

  std::map<std::string, std::optional<Nanoseconds>> requests_;
  std::optional<Nanoseconds> released_;
};

}  // namespace hlc::lab_control
