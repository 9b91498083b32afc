#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/paper_distance.hpp"
#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc::campaign {

/// A combination of settings compared with the paper's Table 2. The nearest is chosen by the
/// distance over the first half of the starts (rounded up), which is therefore biased; the other
/// half, which had no part in the choice, measures how near it really is.
struct JudgedCombination {
  std::size_t combination{};
  PaperDistance choosing;                 ///< over the starts that choose
  std::optional<PaperDistance> held_out;  ///< over the others; none with a single start
  /// False if its distance is significantly larger than that of the chosen one: the 95 % interval
  /// of the difference of sqrt(D), start by start over the held-out ones, lies above 0.
  bool may_be_as_near{};
};

/// The combinations with cells in the paper, nearest by `choosing` first.
/// @param runs  one per run of the sweep
[[nodiscard]] std::vector<JudgedCombination> judged_combinations(
    const Sweep& sweep, const std::vector<RunFigures>& runs);

/// Markdown: the nearest combinations, the chosen one's cells beside the paper's, and for every
/// value of every setting the distance of the combinations with it, and how many of them may be as
/// near as the chosen one. Empty if the paper has no cell for these runs.
[[nodiscard]] std::string paper_comparison(const Sweep& sweep, const std::vector<RunFigures>& runs);

}  // namespace hlc::campaign
