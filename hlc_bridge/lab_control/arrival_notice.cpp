#include "hlc_bridge/lab_control/arrival_notice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hlc::lab_control {

std::optional<std::string> ArrivalNotice::note(const coordination::Report& report, StepIndex start,
                                               double step_s) {
  const auto before = std::exchange(arrived_since_, report.arrived_since);
  if (!arrived_since_ || before == arrived_since_) return std::nullopt;
  const std::uint64_t steps = arrived_since_->value - std::min(*arrived_since_, start).value;
  return fmt::format("vehicle {} arrived at its goal after {:.1f} s", report.vehicle.value,
                     step_s * static_cast<double>(steps));
}

}  // namespace hlc::lab_control
