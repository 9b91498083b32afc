#pragma once

#include <vector>

#include "vehicle_sim/campaign/figure_parts.hpp"

/// Distributions of samples, as lines for a logarithmic axis.
namespace hlc::campaign {

/// The outline of a histogram with ten bins a decade, [10^(k/10), 10^((k+1)/10)): from 0 up, along
/// each bin, down to 0. Heights are percentages of the sample; empty of an empty sample.
/// @pre sorted, all > 0
[[nodiscard]] PlotPoints decade_histogram(const std::vector<double>& sorted);

/// Share [%] of the sample that is at least as large, at each of its values. @pre sorted
[[nodiscard]] PlotPoints exceedance(const std::vector<double>& sorted);

}  // namespace hlc::campaign
