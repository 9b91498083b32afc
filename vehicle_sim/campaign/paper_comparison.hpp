#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/paper_distance.hpp"
#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc {

/// A combination of settings beside the paper's Table 2. By the distance over the first half of the
/// starts (rounded up) the nearest is chosen, so that distance looks better than it is; how near it
/// is the other half says, which had no part in the choice.
struct JudgedCombination {
  std::size_t combination{};
  PaperDistance choosing;                 ///< over the starts that choose
  std::optional<PaperDistance> held_out;  ///< over the others; none with a single start
  /// False if its distance is for sure larger than that of the one that was chosen: the 95 %
  /// interval of the difference of sqrt(D), start by start over those held out, lies above 0.
  bool may_be_as_near{};
};

/// Those that the paper has cells for, nearest by `choosing` first.
/// @param runs  one per run of the sweep
[[nodiscard]] std::vector<JudgedCombination> judged_combinations(
    const Sweep& sweep, const std::vector<RunFigures>& runs);

/// Markdown: the nearest combinations, the chosen one's cells beside the paper's, and for every
/// value of every setting how near the combinations with it come, and how many of them may be as
/// near as the chosen one. Empty if the paper has no cell for these runs.
[[nodiscard]] std::string paper_comparison(const Sweep& sweep, const std::vector<RunFigures>& runs);

}  // namespace hlc
