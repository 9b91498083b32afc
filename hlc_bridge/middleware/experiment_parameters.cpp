#include "hlc_bridge/middleware/experiment_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hlc_bridge/machine/log_line.hpp"

namespace hlc::middleware {

std::string validate(const RunParameters& parameters, std::span<const std::uint8_t> vehicle_ids,
                     Nanoseconds offset) {
  if (parameters.period() <= offset) {
    return fmt::format("{} = {} ms, must be more than --offset_nanoseconds = {}", kPeriodParameter,
                       parameters.period() / kNanosecondsPerMillisecond, offset);
  }
  const std::vector<std::int32_t>& active = parameters.active_ids();
  const auto is_in_range = [](std::int32_t id) { return id >= 1 && id <= 255; };
  const auto is_active_once = [&](std::uint8_t id) { return std::ranges::count(active, id) == 1; };
  if (!std::ranges::all_of(active, is_in_range) ||
      !std::ranges::all_of(vehicle_ids, is_active_once)) {
    return fmt::format("{} = {}, must be in 1 ... 255 and hold --vehicle_ids = {} once",
                       kActiveIdsParameter, fmt::join(active, ", "), fmt::join(vehicle_ids, ", "));
  }
  return {};
}

bool NextExperiment::request_is_due(Nanoseconds now) {
  if (now < next_request_) return false;
  next_request_ = now + kRequestInterval;
  answers_ = RunParameters{};
  return true;
}

NextExperiment::Outcome NextExperiment::evaluate(std::span<const std::uint8_t> vehicle_ids,
                                                 Nanoseconds offset, Nanoseconds period) {
  if (!answers_.complete()) return {};
  std::string problem = validate(answers_, vehicle_ids, offset);
  if (problem.empty() && answers_.period() != period) {
    problem = fmt::format("{} = {} ms, must be the {} ms of this process's start", kPeriodParameter,
                          answers_.period() / kNanosecondsPerMillisecond,
                          period / kNanosecondsPerMillisecond);
  }
  is_known_ = problem.empty();
  const bool is_new = problem != std::exchange(last_problem_, problem);
  if (is_known_) return {.parameters = answers_, .problem = {}};
  return {.parameters = std::nullopt, .problem = is_new ? problem : std::string{}};
}

}  // namespace hlc::middleware
