#pragma once

#include <cstdint>
#include <optional>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::time {

/// A clock that begins with the system's time and goes on steadily: a system clock that is set
/// during a run changes nothing. All processes of a machine that run then go on together, and with
/// those of other machines; frequency corrections (NTP) reach both clocks.
///
/// Limit: a process that is started after the system's clock was set has another time than the run.
class SteadyRealTime {
 public:
  using Clock = Nanoseconds (*)();

  /// @param system  since the Unix epoch; may be set
  /// @param steady  see wall_time_now
  SteadyRealTime(Clock system, Clock steady);

  /// Since the Unix epoch. @param steady  an instant of the steady clock
  [[nodiscard]] Nanoseconds at(Nanoseconds steady) const {
    return steady + static_cast<Nanoseconds>(offset_);
  }
  /// By how much the system's clock has been set since the construction [ns], positive: forth.
  [[nodiscard]] std::int64_t system_step() const { return offset_now() - offset_; }

 private:
  [[nodiscard]] std::int64_t offset_now() const;

  Clock system_;
  Clock steady_;
  std::int64_t offset_;  ///< of the system's clock from the steady one at the construction
};

/// The process's: time of runs in real time. It begins with the first call.
[[nodiscard]] const SteadyRealTime& steady_real_time();
/// Now, by it.
[[nodiscard]] Nanoseconds real_time_now();

/// Notices that the system's clock was set.
class SystemClockWatch {
 public:
  /// What to log: once for each time that it was set, by at least kLeastStep.
  [[nodiscard]] std::optional<std::int64_t> new_step(std::int64_t system_step);

  /// Far more than reading two clocks takes, and less than a run notices.
  static constexpr std::int64_t kLeastStep = 5'000'000;  // ns

 private:
  std::int64_t last_{};
};

}  // namespace hlc::time
