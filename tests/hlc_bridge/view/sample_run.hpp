#pragma once

#include <cstdint>
#include <string>

#include "hlc_bridge/view/page_messages.hpp"

namespace hlc::view {

/// Step from which on the second car waits for the first, and the one in which it falls back.
inline constexpr std::uint64_t kWaitsFrom = 5;
inline constexpr std::uint64_t kFallsBackIn = 8;

/// Cars side by side, each with a length of road, for `steps` steps from k0 = 7 on: they drive in a
/// circle, trim 7 of the test automaton, recorded every 20 ms, 1 mm ahead of their plans; the
/// second stands. Car i has id i, and the first one's name is `name`.
[[nodiscard]] FinishedRun sample_run(std::uint8_t cars, std::uint64_t steps,
                                     const std::string& name = "red");

/// What is known of a run before it begins.
[[nodiscard]] FinishedRun before(const FinishedRun& run);

}  // namespace hlc::view
