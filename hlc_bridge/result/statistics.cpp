#include "hlc_bridge/result/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace hlc::result {

std::optional<Statistics> statistics(std::span<const double> sample) {
  if (sample.empty()) {
    return std::nullopt;
  }
  std::vector<double> sorted(sample.begin(), sample.end());
  std::sort(sorted.begin(), sorted.end());
  const double n = static_cast<double>(sorted.size());
  Statistics result;
  result.count = sorted.size();
  result.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / n;
  double squares = 0.0;
  for (const double value : sorted) {
    squares += (value - result.mean) * (value - result.mean);
  }
  result.std = sorted.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
  const auto rank = (sorted.size() * 99 + 99) / 100;  // ceil(0.99 n)
  result.p99 = sorted[rank - 1];
  result.min = sorted.front();
  result.max = sorted.back();
  return result;
}

}  // namespace hlc::result
