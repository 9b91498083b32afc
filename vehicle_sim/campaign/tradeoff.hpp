#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc::campaign {

/// Rows keep the limits of the speed zones if in no start they are clearly above them
/// (kFollowerExcess_mps) for more than this share of the time in zones.
inline constexpr double kMostAboveLimit = 0.01;

/// Markdown: whether switching subgraphs while driving is worthwhile. For each scenario and profile
/// every fixed subgraph and every policy is a row, with medians over the starts in which the run
/// counts and the vehicle of highest priority drove a lap. A value that is unknown for one of these
/// starts is unknown.
///
/// Then the non-dominated rows, the hypervolume (tradeoff_front.hpp) of all fixed subgraphs
/// together, and the gain of each single policy over it, in
///
/// * lap time and effort per metre,
/// * lap time and comfort per metre,
/// * reference error of driven positions and effort per metre,
///
/// of all rows, and of those that keep the limits of the speed zones, with the same reference
/// points. Rows without values do not compete.
[[nodiscard]] std::string tradeoff_markdown(const std::vector<RunFigures>& runs);

/// The rows as comma-separated values; unknown values are empty.
[[nodiscard]] std::string tradeoff_csv(const std::vector<RunFigures>& runs);

/// Dominance and hypervolumes as comma-separated values: for each scenario, profile, set of rows
/// (`all`, `within_limits`) and pair of quantities one row per row that competes, with the
/// hypervolume of all fixed subgraphs (`fixed`) and of these and the row together (`with`).
[[nodiscard]] std::string tradeoff_fronts_csv(const std::vector<RunFigures>& runs);

}  // namespace hlc::campaign
