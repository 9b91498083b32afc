#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/paper_table.hpp"

namespace hlc::campaign {

/// One of the paper's cells and ours.
struct ComparedCell {
  PapersCell paper;
  std::optional<double> ours;  ///< mean over the starts; none if one of them has none, or failed
  double log_ratio{};          ///< l, see paper_distance
};

/// Distance of runs to the machine-independent cells of the paper's Table 2.
struct PaperDistance {
  std::vector<ComparedCell> cells;
  double mean_square{};  ///< D

  /// exp(sqrt(D)): the typical factor between our cells and the paper's.
  [[nodiscard]] double factor() const;
};

/// The most that a cell can count: a factor of 10.
inline constexpr double kMaxCellFactor = 10.0;

/// Compares the runs, over all their starts, with the cells of their scenarios and subgraphs:
///
///     D = 1/n sum_i l_i^2,   l_i = ln(ours_i / paper_i), at most ln 10 in size
///
/// so that twice as much and half as much count the same, whatever the unit. A cell without a value
/// of ours (no lap, a failed run) counts ln 10. Cells: mean and standard deviation of the reference
/// error, lap, largest number of generated vertices ("expanded" in the paper) in a step: of the car
/// alone, or summed over three cars.
///
/// The paper has subgraph A with three cars only. Its error and lap there are also compared with a
/// red car alone, which is of highest priority: the others do not slow it down.
///
/// @return nothing if the paper has no cell for any of the runs
[[nodiscard]] std::optional<PaperDistance> paper_distance(const std::vector<RunFigures>& runs);

}  // namespace hlc::campaign
