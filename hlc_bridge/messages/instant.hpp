#pragma once

#include <optional>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc {

/// Now, by the two clocks that a machine knows.
struct Instant {
  /// Time of the run. In logical time that of the tick released last: it stands still between
  /// ticks. In real time CLOCK_REALTIME, which may be set back.
  Nanoseconds run{};
  Nanoseconds wall{};  ///< monotonic: for patience and repetitions
};

/// When a machine must be advanced though nothing came: at the earlier of the two; empty: not by
/// that clock.
struct WakeUp {
  std::optional<Nanoseconds> run{};
  std::optional<Nanoseconds> wall{};
};

}  // namespace hlc
