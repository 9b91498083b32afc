#include "vehicle_sim/campaign/interval.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "hlc_bridge/result/statistics.hpp"
#include "vehicle_sim/campaign/number_text.hpp"

namespace hlc::campaign {
namespace {

/// The 97.5 % quantile of Student's distribution, to 2e-3 at least.
double student_quantile(std::size_t degrees) {
  static constexpr std::array kSmall{12.7062, 4.3027, 3.1824, 2.7764, 2.5706,
                                     2.4469,  2.3646, 2.3060, 2.2622, 2.2281};
  if (degrees <= kSmall.size()) return kSmall.at(degrees - 1);
  // Cornish and Fisher's expansion around the normal distribution's quantile.
  constexpr double kZ = 1.959964;
  constexpr double kZ3 = kZ * kZ * kZ;
  constexpr double kZ5 = kZ3 * kZ * kZ;
  const auto n = static_cast<double>(degrees);
  return kZ + (kZ3 + kZ) / (4.0 * n) + (5.0 * kZ5 + 16.0 * kZ3 + 3.0 * kZ) / (96.0 * n * n);
}

}  // namespace

bool Interval::is_off_zero() const { return half_width && std::abs(mean) > *half_width; }

std::optional<Interval> interval_of_mean(const std::vector<double>& values) {
  const std::optional<result::Statistics> sample = result::statistics(values);
  if (!sample) return std::nullopt;
  Interval interval{.mean = sample->mean, .half_width = {}, .count = sample->count};
  if (sample->count > 1) {
    interval.half_width = student_quantile(sample->count - 1) * sample->std /
                          std::sqrt(static_cast<double>(sample->count));
  }
  return interval;
}

std::optional<Interval> interval_over_starts(const ValuesByStart& values) {
  std::vector<double> means;
  for (const auto& [start, of_start] : values) {
    if (of_start.empty()) continue;
    means.push_back(std::accumulate(of_start.begin(), of_start.end(), 0.0) /
                    static_cast<double>(of_start.size()));
  }
  return interval_of_mean(means);
}

std::string in_words(const std::optional<Interval>& interval, int decimals) {
  if (!interval) return "-";
  const std::string mean = number(interval->mean, decimals);
  return interval->half_width ? mean + " ± " + number(*interval->half_width, decimals) : mean;
}

}  // namespace hlc::campaign
