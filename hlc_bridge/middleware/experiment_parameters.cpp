#include "hlc_bridge/middleware/experiment_parameters.hpp"

#include <algorithm>
#include <utility>

#include "hlc_bridge/machine/log_line.hpp"

namespace hlc::middleware {
namespace {

std::string milliseconds(Nanoseconds time) {
  return std::to_string(time / kNanosecondsPerMillisecond) + " ms";
}

}  // namespace

std::string validate(const RunParameters& parameters, std::span<const std::uint8_t> vehicle_ids,
                     Nanoseconds offset) {
  if (parameters.period() <= offset) {
    return std::string{kPeriodParameter} + " = " + milliseconds(parameters.period()) +
           ", must be more than --offset_nanoseconds = " + std::to_string(offset);
  }
  const std::vector<std::int32_t>& active = parameters.active_ids();
  const auto is_in_range = [](std::int32_t id) { return id >= 1 && id <= 255; };
  const auto is_active_once = [&](std::uint8_t id) { return std::ranges::count(active, id) == 1; };
  if (!std::ranges::all_of(active, is_in_range) ||
      !std::ranges::all_of(vehicle_ids, is_active_once)) {
    return std::string{kActiveIdsParameter} + " = " + machine::joined(active) +
           ", must be in 1 ... 255 and hold --vehicle_ids = " + machine::joined(vehicle_ids) +
           " once";
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
    problem = std::string{kPeriodParameter} + " = " + milliseconds(answers_.period()) +
              ", must be the " + milliseconds(period) + " of this process's start";
  }
  is_known_ = problem.empty();
  const bool is_new = problem != std::exchange(last_problem_, problem);
  if (is_known_) return {.parameters = answers_, .problem = {}};
  return {.parameters = std::nullopt, .problem = is_new ? problem : std::string{}};
}

}  // namespace hlc::middleware
