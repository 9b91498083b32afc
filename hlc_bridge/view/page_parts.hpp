#pragma once

#include <cstddef>
#include <map>
#include <span>

#include "hlc_bridge/view/page_json.hpp"
#include "hlc_bridge/view/page_messages.hpp"

/// Messages that a finished run and one under way have in common.
namespace hlc::view {

/// The message `run`: all of the run but rows, drives and log.
[[nodiscard]] Json run_message(const FinishedRun& run);

/// The message `drive`: states every `tick`.
/// @param begin  t(0) of the run
/// @pre samples is not empty
[[nodiscard]] Json drive_message(int vehicle, std::span<const result::DrivenSample> samples,
                                 Nanoseconds begin, Nanoseconds tick);

/// The message `log`.
[[nodiscard]] Json log_message(const std::vector<result::LoggedLine>& log);

/// A scenario may have more vehicles than a run.
[[nodiscard]] bool takes_part(VehicleId vehicle, const result::RunFacts& facts);

/// Of the cars, in page/page.css and scene.cpp.
inline constexpr std::size_t kNumColours = 8;

/// Numbers of the colours of those that take part: the named one, or by their order.
[[nodiscard]] std::map<VehicleId, std::size_t> colours_of(const FinishedRun& run);

}  // namespace hlc::view
