#include "vehicle_sim/campaign/distribution.hpp"

#include <cmath>
#include <map>

namespace hlc::campaign {

PlotPoints decade_histogram(const std::vector<double>& sorted) {
  constexpr double kBinsPerDecade = 10.0;
  const auto bin_of = [](double value) {
    return static_cast<int>(std::floor(kBinsPerDecade * std::log10(value)));
  };
  std::map<int, std::size_t> counts;
  for (const double value : sorted) ++counts[bin_of(value)];
  PlotPoints points;
  if (sorted.empty()) return points;
  const auto add = [&](int bin, double height) {
    points.emplace_back(std::pow(10.0, bin / kBinsPerDecade), height);
  };
  const int first = counts.begin()->first;
  const int last = counts.rbegin()->first;
  add(first, 0.0);
  for (int bin = first; bin <= last; ++bin) {
    const double height =
        100.0 * static_cast<double>(counts[bin]) / static_cast<double>(sorted.size());
    add(bin, height);
    add(bin + 1, height);
  }
  add(last + 1, 0.0);
  return points;
}

PlotPoints exceedance(const std::vector<double>& sorted) {
  PlotPoints points;
  const auto count = static_cast<double>(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double at_least = 100.0 * (count - static_cast<double>(i)) / count;
    points.emplace_back(sorted[i], at_least);
  }
  return points;
}

}  // namespace hlc::campaign
