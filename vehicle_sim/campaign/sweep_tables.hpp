#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc::campaign {

/// Results by the values of settings: for every grouping (groupings_of), scenario, group and
/// subgraph how many runs drove a lap, and of these error of planned and of driven positions, lap
/// and largest number of generated vertices: means with 95 % intervals (interval_over_starts).
/// @param runs  one per run of the sweep
[[nodiscard]] std::string sweep_tables_markdown(const Sweep& sweep,
                                                const std::vector<RunFigures>& runs);

/// The same as comma-separated values, one row per quantity: scenario, settings and values
/// (separated by semicolons), subgraph, combinations, runs, laps, quantity, mean, half_width.
[[nodiscard]] std::string sweep_tables_csv(const Sweep& sweep, const std::vector<RunFigures>& runs);

}  // namespace hlc::campaign
