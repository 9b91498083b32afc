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
  /// False in logical time until the first tick has been released: no tick is due yet, and `run` is
  /// 0. (The first tick may be that of time 0.)
  bool has_begun{true};
};

/// When a machine must be advanced though nothing came: at the earlier of the two; empty: not by
/// that clock. In logical time a `run` asks for the release of that very tick and says that all
/// before it is done; so it is empty while a tick waits for messages.
struct WakeUp {
  std::optional<Nanoseconds> run{};
  std::optional<Nanoseconds> wall{};
};

}  // namespace hlc
