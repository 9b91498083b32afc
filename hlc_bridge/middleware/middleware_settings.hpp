#pragma once

#include <cstdint>
#include <vector>

#include "hlc_bridge/machine/pacing_rules.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::middleware {

/// Differences between middlewares in logical and in real time, and beside the lab's programs.
struct MiddlewareRules {
  machine::PacingRules pacing;
  /// The middleware reports to the lab control every period that its controllers are ready, until
  /// the first trigger.
  bool announces_readiness{};
  /// Controllers receive every trigger; otherwise the first one and the stop symbol.
  bool forwards_every_trigger{};
  /// Lists hold the camera system's observations.
  bool lists_observations{};
  /// A tick waits for the answer of a controller that has not answered before, even of one that is
  /// not ours.
  bool awaits_first_answers{};
};

/// @param beside_lab_programs  controllers and vehicles may be the lab's own: they expect all
/// triggers, those of the vehicles' ticks too, and do not answer before the start. Ours need 50
/// triggers a second less, which would slow down a run considerably. And the operator starts the
/// run: the first tick is requested at once, and waits for the controllers, since time would pass
/// without a middleware that had not requested any.
[[nodiscard]] constexpr MiddlewareRules logical_middleware_rules(bool beside_lab_programs) {
  machine::PacingRules pacing = machine::logical_rules();
  pacing.connects_before_start = !beside_lab_programs;
  return {.pacing = pacing,
          .announces_readiness = false,
          .forwards_every_trigger = beside_lab_programs,
          .lists_observations = beside_lab_programs,
          .awaits_first_answers = !beside_lab_programs};
}

/// The controllers need lists until their cars stand.
[[nodiscard]] constexpr MiddlewareRules real_middleware_rules(bool beside_lab_programs) {
  return {.pacing = machine::real_rules(kMiddlewareStays),
          .announces_readiness = true,
          .forwards_every_trigger = true,
          .lists_observations = beside_lab_programs,
          .awaits_first_answers = false};
}

struct MiddlewareSettings {
  std::vector<std::uint8_t> vehicle_ids;  ///< of its controllers; at least one, each once
  Nanoseconds offset{kListOffset};        ///< of the lists in a period
  /// After the stop symbol wait for the next experiment instead of ending. Not with patience > 0.
  bool keep_running{};
  Nanoseconds startup_timeout{30 * kNanosecondsPerSecond};  ///< wall time
  MiddlewareRules rules;
};

}  // namespace hlc::middleware
