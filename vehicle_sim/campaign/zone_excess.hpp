#pragma once

#include <optional>
#include <span>

#include "hlc_bridge/result/run_record.hpp"
#include "planner/policy/policy_settings.hpp"

namespace hlc::campaign {

/// How much vehicles exceeded the limits of speed zones, by their true states at every tick. No
/// tolerance: a car at its limit is above it now and then, by the corrections of its follower.
struct ZoneExcess {
  double share{};        ///< of the time that all vehicles together spent in zones, that above
  double clear_share{};  ///< that more than kFollowerExcess_mps above
  double max_mps{};      ///< the largest excess; 0 if there was none
};

/// A larger excess is not caused by the follower: on subgraphs without a trim or maneuver above 0.6
/// m/s the simulated cars are at most 0.065 m/s faster.
inline constexpr double kFollowerExcess_mps = 0.1;

/// From the first step to the end of the last one. A vehicle is in a zone if its position is; of
/// several zones the lowest limit counts.
/// @return nothing without zones, or if no vehicle entered one
[[nodiscard]] std::optional<ZoneExcess> zone_excess(std::span<const policy::SpeedZone> zones,
                                                    const result::Drives& drives,
                                                    const result::RunFacts& facts);

}  // namespace hlc::campaign
