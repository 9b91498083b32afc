#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc::campaign {

/// One row per run, in the order of the sweep: run, combination, scenario, subgraph, start, the
/// settings by name, then lap_s, error_mean_mm, error_std_mm, generated_max, generated_sum_max,
/// expanded_max, expanded_sum_max, deviation_max_mm, fallback_steps, distance (D of the run's
/// combination, see paper_distance), failure (empty if it counts; no commas). Cells of a run that
/// was not driven are empty.
/// @param runs  one per run of the sweep
[[nodiscard]] std::string sweep_csv(const Sweep& sweep, const std::vector<RunFigures>& runs);

}  // namespace hlc::campaign
