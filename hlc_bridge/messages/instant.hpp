#pragma once

#include <optional>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc {

/// Now, by the two clocks of a machine.
struct Instant {
  /// Time of the run. In logical time that of the last released tick: it stands still between
  /// ticks. In real time CLOCK_REALTIME, which may be set back.
  Nanoseconds run{};
  Nanoseconds wall{};  ///< monotonic: for timeouts and repetitions
  /// False in logical time until the first tick has been released: no tick is due yet, and `run` is
  /// 0. (The first tick may be that of time 0.)
  bool has_begun{true};
};

/// When a machine must be advanced without an event: at the earlier of the two; empty: not by that
/// clock. In logical time a `run` requests the release of that very tick and means that everything
/// before it is done; so it is empty while a tick waits for messages.
struct WakeUp {
  std::optional<Nanoseconds> run{};
  std::optional<Nanoseconds> wall{};
};

}  // namespace hlc
