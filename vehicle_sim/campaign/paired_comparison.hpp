#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc::campaign {

/// Markdown: the effect of each value of a setting, against the setting's first one. A pair are two
/// runs of the same scenario, subgraph and start (hence seed), with all other settings equal: of
/// every grouping (groupings_of) the last setting's values, for each combination of the others'. Of
/// the pairs in which both drove a lap the differences of error, lap and largest number of
/// generated vertices; and of the pairs of all of a start's subgraphs the ratio of the factors
/// exp(sqrt(D)) by which they are off the paper's Table 2 (paper_distance.hpp), if it has cells for
/// them. Means with 95 % intervals (interval_over_starts). Empty if no setting has several values.
/// @param runs  one per run of the sweep
[[nodiscard]] std::string paired_comparison(const Sweep& sweep,
                                            const std::vector<RunFigures>& runs);

}  // namespace hlc::campaign
