#pragma once

#include <optional>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc {

/// Ticks of a periodic process, in real or in logical time: at k * period + offset, k whole,
/// increasing.
class Timer {
 public:
  Timer() = default;
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
  virtual ~Timer() = default;

  /// Waits for the next tick and returns its time; nothing from the moment the timer is stopped. To
  /// be called from one thread.
  [[nodiscard]] virtual std::optional<Nanoseconds> wait_next() = 0;

  /// Ends the timer, also while another thread is in wait_next. From any thread, any number of
  /// times.
  virtual void stop() = 0;
};

}  // namespace hlc
