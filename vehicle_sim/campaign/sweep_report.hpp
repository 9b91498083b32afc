#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/evaluation_table.hpp"
#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc::campaign {

/// Markdown: the combinations compared with the paper's Table 2 (paper_comparison.hpp) or, if
/// `trims` is swept, the front of choices (trims_front.hpp); which subgraph is more accurate
/// (accuracy_comparison.hpp); the effect of each setting, pair by pair (paired_comparison.hpp);
/// results by setting (sweep_tables.hpp); failures and their reasons (failure_list.hpp).
/// @param runs  one per run of the sweep
[[nodiscard]] std::string sweep_markdown(const Sweep& sweep, const std::vector<RunFigures>& runs,
                                         const EvaluationOrigin& origin);

}  // namespace hlc::campaign
