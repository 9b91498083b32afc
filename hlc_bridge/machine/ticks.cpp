#include "hlc_bridge/machine/ticks.hpp"

#include <stdexcept>
#include <string>

namespace hlc::machine {

Ticks::Ticks(Nanoseconds period, Nanoseconds offset, const Instant& now) : period_(period) {
  if (offset >= period) {
    throw std::invalid_argument("ticks: offset " + std::to_string(offset) +
                                " ns must be less than the period " + std::to_string(period) +
                                " ns");
  }
  next_ = next_on_grid(now.run, period, offset);
}

std::optional<Nanoseconds> Ticks::take(const Instant& now) {
  if (!now.has_begun || now.run < next_) return std::nullopt;
  const std::uint64_t late_periods = (now.run - next_) / period_;
  missed_ += late_periods;
  const Nanoseconds tick = next_ + late_periods * period_;
  next_ = tick + period_;
  return tick;
}

}  // namespace hlc::machine
