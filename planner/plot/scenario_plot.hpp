#pragma once

#include <optional>
#include <string>

#include "planner/plot/svg_plot.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::plot {

/// The scenario's map; nothing on open ground. @throws std::runtime_error as read_lanelet_map
[[nodiscard]] std::optional<road::LaneletMap> map_of(const scenario::Scenario& scenario);

/// Lanes in grey with their bounds.
void add_lanes(const road::LaneletMap& map, PlotPanel& panel);

/// A path as one line, back to its first point if it is closed.
[[nodiscard]] PlotLine path_line(const road::ReferencePath& path);

/// A vehicle with a name such as "red" has that colour, others one by their index in the scenario.
[[nodiscard]] std::string car_colour(const scenario::Scenario& scenario, std::size_t vehicle);

/// The paper's Fig. 3, as SVG: lanes, the vehicles' reference paths with their direction,
/// footprints (without margin, the front white) and ids at the start. Paths that share a lane are
/// drawn with widths that differ.
/// @param map         absent: open ground
/// @param with_poses  the legend holds the vehicles' poses (yaw): a sheet to place them by
[[nodiscard]] std::string scenario_plot(const scenario::Scenario& scenario,
                                        const std::optional<road::LaneletMap>& map,
                                        bool with_poses = false);

}  // namespace hlc::plot
