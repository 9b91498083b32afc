#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/evaluation_table.hpp"
#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc {

/// One row per run, in the order of the sweep: run, combination, scenario, subgraph, start, the
/// settings by name, then lap_s, error_mean_mm, error_std_mm, generated_max, generated_sum_max,
/// expanded_max, expanded_sum_max, deviation_max_mm, fallback_steps, distance (D of the run's
/// combination, see paper_distance), failure (empty if it counts; no commas). Cells of a run that
/// was not driven are empty.
/// @param runs  one per run of the sweep
[[nodiscard]] std::string sweep_csv(const Sweep& sweep, const std::vector<RunFigures>& runs);

/// Markdown. If the paper has cells for these runs: the combinations next to its Table 2, with D
/// over all starts and the smallest and largest D of one start; the best one's cells beside the
/// paper's; and for every value of every setting how near the combinations with it come, and how
/// many of them are as good as the best as far as the starts can tell: their D is not above the
/// best's largest D of one start; then accuracy_comparison.hpp. If `trims` is swept: see
/// trims_front.hpp. At last what failed and why; reasons that differ in numbers only are one, with
/// the range of these numbers.
[[nodiscard]] std::string sweep_markdown(const Sweep& sweep, const std::vector<RunFigures>& runs,
                                         const EvaluationOrigin& origin);

}  // namespace hlc
