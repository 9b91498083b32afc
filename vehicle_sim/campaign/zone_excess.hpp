#pragma once

#include <optional>
#include <span>

#include "hlc_bridge/core/run_record.hpp"
#include "planner/policy/policy_settings.hpp"

namespace hlc {

/// How far vehicles were above the limits of speed zones, by their true states at every tick. No
/// tolerance: a car that is to drive at a limit is above it now and then, by what its follower
/// corrects.
struct ZoneExcess {
  double share{};    ///< of the time that all vehicles together spent in zones, that above
  double max_mps{};  ///< the largest excess; 0 if there was none
};

/// From the first step to the end of the last one. A vehicle is in a zone if its position is; of
/// several zones the lowest limit counts.
/// @return nothing without zones, or if nobody came into one
[[nodiscard]] std::optional<ZoneExcess> zone_excess(std::span<const SpeedZone> zones,
                                                    const Drives& drives, const RunFacts& facts);

}  // namespace hlc
