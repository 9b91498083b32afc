#pragma once

#include <optional>
#include <span>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc {

/// What was driven cost, per driven metre, over all vehicles: for a criterion c
///
///     sum over the driven maneuvers of c / metres driven meanwhile
///
/// A driven maneuver is the one that a report names (maneuver_during), its costs are those that the
/// universal automaton holds of it, and metres are those of the true positions from tick to tick.
struct DrivenCosts {
  std::optional<double> effort_per_m;   ///< criterion J2
  std::optional<double> comfort_per_m;  ///< criterion comfort
};

/// The last step, of which nobody reported how it ended, is left out.
///
/// A value is absent, never smaller than it was, if the cost of any maneuver is not known: one of
/// new weights that the automaton does not hold, or an automaton without that criterion; so it is
/// if nobody moved.
/// @param rows       of step_records(), those that count
/// @param automaton  that was planned on
[[nodiscard]] DrivenCosts driven_costs(std::span<const StepRecord> rows, const Drives& drives,
                                       const RunFacts& facts, const UniversalAutomaton& automaton);

}  // namespace hlc
