#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/geometry/polygon.hpp"

namespace hlc::road {

/// Number of a lanelet in its file, at least 1.
using LaneletId = int;

/// A piece of one lane, driven from the first to the last point of its bounds (map frame).
struct Lanelet {
  struct Adjacent {
    LaneletId id{};
    bool same_direction{};  ///< drivingDir: true for "same", false for "opposite"
    friend bool operator==(const Adjacent&, const Adjacent&) = default;
  };

  LaneletId id{};
  std::vector<Point> left_m;   ///< left bound, at least 2 points
  std::vector<Point> right_m;  ///< right bound, as many points as the left one
  std::vector<LaneletId> predecessors;
  std::vector<LaneletId> successors;
  std::optional<Adjacent> adjacent_left;
  std::optional<Adjacent> adjacent_right;

  friend bool operator==(const Lanelet&, const Lanelet&) = default;
};

/// Points midway between the i-th points of both bounds.
[[nodiscard]] std::vector<Point> centre_line_m(const Lanelet& lanelet);

/// The lanelets of a map; every referenced id is in it.
struct LaneletMap {
  std::string benchmark_id;  ///< the map's own name (attribute benchmarkID)
  std::map<LaneletId, Lanelet> lanelets;

  friend bool operator==(const LaneletMap&, const LaneletMap&) = default;
};

/// All lengths `factor` times as long, about the origin; the name stays, so that routes by lanelets
/// hold. For cars of another scale. @pre factor > 0
[[nodiscard]] LaneletMap scaled(LaneletMap map, double factor);

/// The ground that vehicles may use: the box of all lanelets and 30 mm around it. For the lab's map
/// that is its floor, 4.5 m x 4.0 m, to a millimetre.
[[nodiscard]] Box ground_m(const LaneletMap& map);

/// Least distance between points of the same index of a lanelet's two bounds. [m]
[[nodiscard]] double narrowest_lane_m(const LaneletMap& map);

/// Reads the lanelets of a CommonRoad file, 2020a or 2018b. Everything else in it is skipped, so a
/// lanelet may share its id with another kind of element; for what is not to be skipped see
/// map_obstacles.hpp.
/// @throws std::runtime_error one line, `file:line: fault and bound`: file that cannot be read, not
/// XML, other root or version, no benchmarkID, no lanelet; a lanelet with missing, repeated or
/// unknown id, a bound missing, with fewer than 2 points or not as long as the other, a number that
/// is broken or not finite
[[nodiscard]] LaneletMap read_lanelet_map(const std::filesystem::path& file);

/// The same from a text; `name` stands for the file in error messages.
[[nodiscard]] LaneletMap parse_lanelet_map(std::string_view xml, const std::string& name);

/// The map as CommonRoad 2020a, elements in the order of the schema, coordinates with 9 decimals,
/// lanelets by ascending id: equal maps give equal bytes. A planning problem, which the schema
/// requires of a whole benchmark, is left out.
[[nodiscard]] std::string to_commonroad_xml(const LaneletMap& map);

/// @throws std::runtime_error if the file cannot be written
void write_lanelet_map(const LaneletMap& map, const std::filesystem::path& file);

}  // namespace hlc::road
