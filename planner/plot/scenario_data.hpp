#pragma once

#include <nlohmann/json.hpp>

#include "planner/scenario/scenario.hpp"

namespace hlc::plot {

/// Where a scenario is driven, for figures:
///
///     {"scenario": name, "step_s", "has_map",
///      "lanelets": [{"id", "left_m": [[x, y], ...], "right_m"}],     on open ground: []
///      "footprint": {"length_m", "width_m"},                         without margin
///      "vehicles": [{"id", "name", "start": {"x_m", "y_m", "yaw_rad"}, "start_s_m",
///                    "path": {"is_closed", "length_m", "points_m"}}],   by priority
///      "zones": {policy: [{"min_x_m", "max_x_m", "min_y_m", "max_y_m", "max_speed_mps"}]},
///      "obstacles": [{"name", "corners_m": [[x, y], ...]}]}
///
/// `start` is the measured pose (scenario::measured_start). `zones` has the policies that have any.
/// @throws std::runtime_error as read_lanelet_map
[[nodiscard]] nlohmann::ordered_json scenario_data(const scenario::Scenario& scenario);

}  // namespace hlc::plot
