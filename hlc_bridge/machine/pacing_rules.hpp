#pragma once

#include <limits>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::machine {

/// Differences between logical and real time for a machine with ticks, given at construction, so
/// that no machine needs to know which of the two it is in.
struct PacingRules {
  /// How long (wall time) a tick waits for due messages; 0: it uses those that have arrived.
  Nanoseconds patience{};
  /// Before the first tick all endpoints are matched, so that no message of the run is lost.
  bool connects_before_start{};
  /// How long the process continues after the lab control is lost.
  Nanoseconds lab_control_grace{};
};

inline constexpr Nanoseconds kForever = std::numeric_limits<Nanoseconds>::max();

/// Time stands still until every process has answered; without the lab control it does so forever.
[[nodiscard]] constexpr PacingRules logical_rules() {
  return {.patience = kMessageTimeout, .connects_before_start = true, .lab_control_grace = 0};
}

/// Time passes by itself.
/// @param lab_control_grace  of this kind of process: kMiddlewareStays ..., or kForever
[[nodiscard]] constexpr PacingRules real_rules(Nanoseconds lab_control_grace) {
  return {.patience = 0, .connects_before_start = false, .lab_control_grace = lab_control_grace};
}

}  // namespace hlc::machine
