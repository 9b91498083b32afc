#pragma once

#include <algorithm>
#include <vector>

#include "planner/common/demand.hpp"

namespace hlc {

/// The middle value of the sorted sample; for an even number of values the mean of the two middle
/// ones. @pre not empty, no NaN
[[nodiscard]] inline double median(std::vector<double> sample) {
  HLC_DEMAND(!sample.empty());
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::ranges::nth_element(sample, middle);
  if (sample.size() % 2 == 1) return *middle;
  return 0.5 * (*std::max_element(sample.begin(), middle) + *middle);
}

}  // namespace hlc
