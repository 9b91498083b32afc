#include "planner/plot/ticks.hpp"

#include <algorithm>
#include <cmath>

namespace hlc::plot {

std::vector<double> nice_ticks(double min, double max, std::size_t count) {
  const double rough = (max - min) / static_cast<double>(std::max<std::size_t>(count, 1));
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> ticks;
  const double last = std::floor(max / step + 1e-9);
  for (double i = std::ceil(min / step - 1e-9); i <= last; i += 1.0) {
    ticks.push_back(i * step);
  }
  return ticks;
}

std::vector<double> log_ticks(double min, double max) {
  const auto ticks_of = [&](std::initializer_list<double> factors) {
    std::vector<double> ticks;
    for (double power = std::floor(std::log10(min)); power <= std::log10(max); power += 1.0) {
      for (const double factor : factors) {
        const double tick = factor * std::pow(10.0, power);
        if (tick >= min * (1.0 - 1e-9) && tick <= max * (1.0 + 1e-9)) ticks.push_back(tick);
      }
    }
    return ticks;
  };
  const std::vector<double> decades = ticks_of({1.0});
  return decades.size() >= 3 ? decades : ticks_of({1.0, 2.0, 5.0});
}

}  // namespace hlc::plot
