#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc {

/// Whether switching subgraphs while driving pays: every fixed subgraph and every policy of a
/// scenario and profile as a row, with medians over the starts in which the vehicle of highest
/// priority drove a lap and the run counts. A value that is not known for one of these starts is
/// not known.
///
/// Then who is dominated by whom, and the hypervolume (tradeoff_front.hpp) of all fixed subgraphs
/// together and with each single policy, in
///
/// * lap time and effort per metre,
/// * lap time and comfort per metre,
/// * reference error of driven positions and effort per metre,
///
/// of all rows with values, and of those that keep the limits of the speed zones: above them in no
/// more than kMostAboveLimit_mps at any time, whatever the start. Rows without values do not
/// compete.
[[nodiscard]] std::string tradeoff_markdown(const std::vector<RunFigures>& runs);

/// The rows as comma-separated values; what is not known is empty.
[[nodiscard]] std::string tradeoff_csv(const std::vector<RunFigures>& runs);

/// Dominance and hypervolumes as comma-separated values: for each scenario, profile, set of rows
/// (`all`, `within_limits`) and pair of quantities a row per row that competes; the hypervolume is
/// that of all fixed subgraphs with this one, `fixed` that of all fixed subgraphs.
[[nodiscard]] std::string tradeoff_fronts_csv(const std::vector<RunFigures>& runs);

}  // namespace hlc
