#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace hlc::result {

/// Mean, spread and extremes of a sample.
struct Statistics {
  std::size_t count{};
  double mean{};
  double std{};  ///< corrected sample standard deviation (divided by n - 1); 0 for n = 1
  double p99{};  ///< smallest value that >= 99 % of the sample do not exceed (nearest rank)
  double min{};
  double max{};
};

/// Nothing for an empty sample. @pre no NaN
[[nodiscard]] std::optional<Statistics> statistics(std::span<const double> sample);

}  // namespace hlc::result
