#pragma once

#include <optional>
#include <span>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::campaign {

/// The costs of the driven maneuvers, per driven metre, over all vehicles: for a criterion c
///
///     sum over the driven maneuvers of c / metres driven meanwhile
///
/// A driven maneuver is the one that a report names (maneuver_during), its costs are those in the
/// universal automaton, and metres are those of the true positions from tick to tick.
struct DrivenCosts {
  std::optional<double> effort_per_m;   ///< criterion J2
  std::optional<double> comfort_per_m;  ///< criterion comfort
};

/// The last step, whose end no report contains, is left out.
///
/// A value is absent, rather than too small, if the cost of any maneuver is unknown: one of new
/// weights that the automaton does not hold, or an automaton without that criterion; also if no
/// vehicle moved.
/// @param rows       of step_records(), those that count
/// @param automaton  of the plans
[[nodiscard]] DrivenCosts driven_costs(std::span<const result::StepRecord> rows,
                                       const result::Drives& drives, const result::RunFacts& facts,
                                       const automaton::UniversalAutomaton& automaton);

}  // namespace hlc::campaign
