#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace hlc::test {

/// from, from + step, from + 2 step, ... below `end`. @pre step > 0
[[nodiscard]] inline std::vector<double> every(double step, double from, double end) {
  const auto count = static_cast<std::size_t>(std::ceil(std::fmax(0.0, end - from) / step));
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(from + step * static_cast<double>(i));
  }
  return values;
}

}  // namespace hlc::test
