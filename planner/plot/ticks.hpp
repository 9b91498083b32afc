#pragma once

#include <cstddef>
#include <vector>

namespace hlc::plot {

/// Round numbers (1, 2 or 5 times a power of ten apart) that cover [min, max], about `count` of
/// them, from the first at or above min to the last at or below max. @pre min < max
[[nodiscard]] std::vector<double> nice_ticks(double min, double max, std::size_t count = 6);

/// For a logarithmic axis: the powers of ten within [min, max]; if these are fewer than three, two
/// and five times them as well. @pre 0 < min < max
[[nodiscard]] std::vector<double> log_ticks(double min, double max);

}  // namespace hlc::plot
