#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc::campaign {

/// Markdown: how many runs do not count, and why. Reasons that differ in numbers only are merged,
/// with the range of these numbers. Empty if all count.
[[nodiscard]] std::string failure_list(const std::vector<RunFigures>& runs);

}  // namespace hlc::campaign
