#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "planner/plot/plot_frame.hpp"

namespace hlc::plot::svg {

/// The panel's legend, in its corner.
[[nodiscard]] std::string legend_of(const Frame& frame);

/// The entries in rows that are no wider than the picture.
[[nodiscard]] std::vector<std::vector<PlotLegend>> rows_of(const std::vector<PlotLegend>& legend,
                                                           double width_px);

/// Entries side by side, around the middle.
[[nodiscard]] std::string legend_row(const std::vector<PlotLegend>& row,
                                     const Eigen::Vector2d& middle_px);

}  // namespace hlc::plot::svg
