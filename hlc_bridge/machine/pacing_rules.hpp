#pragma once

#include <limits>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::machine {

/// What differs between logical and real time for a machine that ticks. Given to it at
/// construction, so that no machine asks which of the two it is in.
struct PacingRules {
  /// How long (wall time) a tick waits for messages that are due; 0: it takes what has come.
  Nanoseconds patience{};
  /// Before the first tick all endpoints are matched, so that nothing said in the run is lost.
  bool connects_before_start{};
  /// How long the process goes on after the lab control is lost.
  Nanoseconds lab_control_grace{};
};

inline constexpr Nanoseconds kForEver = std::numeric_limits<Nanoseconds>::max();

/// Time stands still until everybody has answered; without the lab control it does for ever.
[[nodiscard]] constexpr PacingRules logical_rules() {
  return {.patience = kMessageTimeout, .connects_before_start = true, .lab_control_grace = 0};
}

/// Time passes by itself.
/// @param lab_control_grace  of this kind of process: kMiddlewareStays ..., or kForEver
[[nodiscard]] constexpr PacingRules real_rules(Nanoseconds lab_control_grace) {
  return {.patience = 0, .connects_before_start = false, .lab_control_grace = lab_control_grace};
}

}  // namespace hlc::machine
