#pragma once

#include <vector>

#include "hlc_bridge/mcap/merge.hpp"
#include "hlc_bridge/view/page_messages.hpp"

namespace hlc::view {

/// A finished run in the message types that viewers of MCAP files draw by themselves (Foxglove,
/// Lichtblick), in JSON. Frame "map" of the scenario, metres; times of the run.
///
/// | topic | type | content |
/// |---|---|---|
/// | `scene/map` | foxglove.SceneUpdate | bounds of the lanes and routes of the vehicles, once |
/// | `scene/cars` | the same | driven footprints with the numbers of the vehicles, every 40 ms |
/// | `scene/plans` | the same | planned path and area of the maneuver under way, every step |
/// | `log` | foxglove.Log | lines of the processes; in real time only, as they have no other stamp
/// |
///
/// Equal runs give equal messages. Numbers that are not finite are 0.
[[nodiscard]] std::vector<mcap::JsonChannel> foxglove_channels(const FinishedRun& run);

}  // namespace hlc::view
