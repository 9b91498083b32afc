#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "planner/geometry/polygon.hpp"

namespace hlc::road {

/// Something on a CommonRoad map that stands for good.
struct MapObstacle {
  int id{};
  std::string type;  ///< as in the file: parkedVehicle, constructionZone, ...
  /// The shapes of the obstacle: its rectangles, polygons around its circles, convex hulls of its
  /// polygons.
  std::vector<ConvexPolygon> areas_m;
  friend bool operator==(const MapObstacle&, const MapObstacle&) = default;
};

/// Reads the static obstacles of a CommonRoad file: <staticObstacle> (2020a), or <obstacle> of
/// <role> static (2018b), each at the exact position and orientation of its initial state.
///
/// Refused by their names are obstacles that move or are unknown, areas of the environment, traffic
/// lights and signs, since no car regards them. All else is skipped: intersections, tags, the
/// location, planning problems (whose vehicle is not the scenario's), and within lanelets their
/// types, stop lines and speed limits.
/// @throws std::runtime_error one line, `file:line: fault and bound`
[[nodiscard]] std::vector<MapObstacle> read_map_obstacles(const std::filesystem::path& file);

/// The same from a text; `name` stands for the file in error messages.
[[nodiscard]] std::vector<MapObstacle> parse_map_obstacles(std::string_view xml,
                                                           const std::string& name);

}  // namespace hlc::road
