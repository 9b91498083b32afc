#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>

#include "hlc_bridge/time/timer.hpp"

namespace hlc {

/// Ticks released one by one by the lab control (lab wire contract, 5.3): the timer publishes which
/// tick it wants next (ReadyStatus), waits for a SystemTrigger with exactly that time, delivers the
/// tick, and so on. Time starts at the offset. Knows no DDS: the owner writes the ready status and
/// forwards the triggers.
///
/// Calling wait_next means that all work of the previous tick is done.
///
/// A lab control can stop responding while its participant still announces itself. Then no trigger
/// arrives, not even for other timers, and after `patience` of wall time the timer ends. In a
/// healthy run, the longest time without a trigger is that in which the lab control detects a
/// death: kMessageTimeout + 2 s = 12 s.
class LogicalTimer : public Timer {
 public:
  static constexpr std::chrono::seconds kPatience{60};

  /// Patience of a process's timer: the first trigger may come as late as the last process appears.
  [[nodiscard]] static std::chrono::seconds patience_for(std::chrono::seconds startup_timeout) {
    return std::max(kPatience, startup_timeout + kPatience / 2);
  }

  /// `send_ready(t)` writes ReadyStatus{node id, t}; it is called from wait_next with no lock held,
  /// at once and then again every `repeat` of wall time until the trigger comes, since a ready
  /// status can be lost. Throws std::invalid_argument unless 0 <= offset < period.
  LogicalTimer(Nanoseconds period, Nanoseconds offset, std::function<void(Nanoseconds)> send_ready,
               std::chrono::milliseconds repeat = std::chrono::seconds{1},
               std::chrono::milliseconds patience = kPatience);

  [[nodiscard]] std::optional<Nanoseconds> wait_next() override;
  void stop() override;

  /// To be called with next_start of every SystemTrigger, from any thread. Triggers for other times
  /// than the awaited one have no effect. The stop symbol ends the timer; a process that continues
  /// to tick after the stop (a vehicle that brakes) does not forward it.
  void on_trigger(Nanoseconds next_start);

  /// True if the timer has ended because no trigger came for too long.
  [[nodiscard]] bool has_given_up() const;

 private:
  Nanoseconds period_;
  Nanoseconds wanted_;
  std::function<void(Nanoseconds)> send_ready_;
  std::chrono::milliseconds repeat_;
  std::chrono::milliseconds patience_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool released_{};  ///< the trigger for wanted_ has come
  bool stopped_{};
  bool has_given_up_{};
  std::chrono::steady_clock::time_point last_trigger_{std::chrono::steady_clock::now()};
};

}  // namespace hlc
