#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc::campaign {

/// Markdown: is a subgraph more accurate than the one that the sweep names before it, and when? For
/// every grouping of the combinations (groupings_of) and every two neighbours of the list: in how
/// many combinations (and scenarios) in which both drive a lap from every start the mean error of
/// the second is smaller, the median of second / first, and, over all pairs of runs with the same
/// settings and start in which both drive a lap, the mean of second - first with its 95 % interval
/// (interval_over_starts). Empty with a single subgraph.
/// @param runs  one per run of the sweep
[[nodiscard]] std::string accuracy_comparison(const Sweep& sweep,
                                              const std::vector<RunFigures>& runs);

}  // namespace hlc::campaign
