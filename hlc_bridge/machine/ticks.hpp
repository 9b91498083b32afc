#pragma once

#include <optional>

#include "hlc_bridge/messages/instant.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::machine {

/// The ticks of a periodic machine, at k * period + offset, k whole. They never repeat or go back,
/// even if the clock does.
///
/// A tick is due when the time of the run has reached it. A tick late by less than a period is
/// delivered late; older ones are skipped and counted. (In logical time none is late.)
class Ticks {
 public:
  /// The first tick is the first of the grid that is not before `now`.
  /// @throws std::invalid_argument unless offset < period
  Ticks(Nanoseconds period, Nanoseconds offset, const Instant& now);

  [[nodiscard]] Nanoseconds period() const { return period_; }
  /// When the next tick is due: for WakeUp::run.
  [[nodiscard]] Nanoseconds next() const { return next_; }
  /// The due tick, once.
  [[nodiscard]] std::optional<Nanoseconds> take(const Instant& now);
  /// Ticks skipped so far.
  [[nodiscard]] std::uint64_t missed() const { return missed_; }

 private:
  Nanoseconds period_;
  Nanoseconds next_{};
  std::uint64_t missed_{};
};

}  // namespace hlc::machine
