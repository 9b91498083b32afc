#include "hlc_bridge/messages/run_parameters.hpp"

#include <variant>

namespace hlc {

void RunParameters::take(const Parameter& parameter) {
  const auto* period_ms = std::get_if<std::uint64_t>(&parameter.value);
  if (period_ms != nullptr && parameter.name == kPeriodParameter && !period_) {
    period_ = *period_ms * kNanosecondsPerMillisecond;
  }
  const auto* ids = std::get_if<std::vector<std::int32_t>>(&parameter.value);
  if (ids != nullptr && parameter.name == kActiveIdsParameter && !active_ids_) {
    active_ids_ = *ids;
  }
}

std::vector<std::string> RunParameters::missing() const {
  std::vector<std::string> names;
  if (!period_) names.emplace_back(kPeriodParameter);
  if (!active_ids_) names.emplace_back(kActiveIdsParameter);
  return names;
}

}  // namespace hlc
