#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc {

/// Markdown: is a subgraph more accurate than the one that the sweep names before it, and when? For
/// every value of every setting and every two neighbours of the list: in how many combinations (and
/// scenarios) in which both drive a lap from every start the mean error of the second is smaller,
/// and the median of second / first. Empty with a single subgraph.
/// @param runs  one per run of the sweep
[[nodiscard]] std::string accuracy_comparison(const Sweep& sweep,
                                              const std::vector<RunFigures>& runs);

}  // namespace hlc
