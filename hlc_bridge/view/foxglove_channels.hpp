#pragma once

#include <optional>
#include <vector>

#include "hlc_bridge/mcap/merge.hpp"
#include "hlc_bridge/view/page_messages.hpp"

namespace hlc::view {

/// A finished run in the message types that viewers of MCAP files draw by themselves (Foxglove,
/// Lichtblick), in JSON. Frame "map" of the scenario, metres; times of the run.
///
/// | topic | type | content |
/// |---|---|---|
/// | `scene/map` | foxglove.SceneUpdate | bounds of lanes, routes of vehicles; once, at the begin |
/// | `scene/cars` | the same | driven footprints with the numbers of all vehicles, every 40 ms |
/// | `scene/plans` | the same | planned path and area of the maneuver under way, every step |
/// | `reports` | hlc.Reports | what the controllers did in a step, every step |
/// | `log` | foxglove.Log | lines of the processes |
///
/// A line without a time of the run, in logical time every one, has that of the line before it, or
/// of the begin of the recording; no line is before that.
///
/// Equal runs give equal scenes. Numbers of a scene that are not finite are 0.
///
/// @param recorded_from  time of the recording's first message; nothing: t(0) of the run
[[nodiscard]] std::vector<mcap::JsonChannel> foxglove_channels(
    const FinishedRun& run, std::optional<Nanoseconds> recorded_from);

}  // namespace hlc::view
