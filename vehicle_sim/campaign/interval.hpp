#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hlc::campaign {

/// A mean and its uncertainty.
struct Interval {
  double mean{};
  /// 95 % of such intervals hold the true mean; none for a single value.
  std::optional<double> half_width;
  std::size_t count{};  ///< independent values

  /// True if 0 lies outside: the sign of the mean is significant.
  [[nodiscard]] bool is_off_zero() const;
};

/// Student's interval of the mean of independent values,
///
///     mean +- t s / sqrt(n),   s their standard deviation, t the 97.5 % quantile for n - 1
/// exact for values from a normal distribution. Nothing without values.
[[nodiscard]] std::optional<Interval> interval_of_mean(const std::vector<double>& values);

/// Values by their start. Values of one start are not independent, so each start counts as one: the
/// mean of its values.
using ValuesByStart = std::map<std::size_t, std::vector<double>>;
[[nodiscard]] std::optional<Interval> interval_over_starts(const ValuesByStart& values);

/// "24.3 ± 0.4", "24.3" without a width, "-" for nothing.
[[nodiscard]] std::string in_words(const std::optional<Interval>& interval, int decimals);

}  // namespace hlc::campaign
