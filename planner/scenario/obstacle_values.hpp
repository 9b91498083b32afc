#pragma once

#include <string>
#include <vector>

#include "planner/common/node.hpp"
#include "planner/geometry/polygon.hpp"

namespace hlc::scenario {

/// Most entries of `obstacles`.
inline constexpr std::size_t kMostObstacles = 100;

/// An entry of `obstacles`.
struct ObstacleValues {
  std::string name;
  ConvexPolygon area_m;
  Node node;  ///< its place in the file, for messages
};

/// The key `obstacles` of a scenario, a list of {name, one of the shapes of area_values.hpp}; none
/// if it is absent.
/// @throws std::invalid_argument with one line: too many, two of one name, or as read_area
[[nodiscard]] std::vector<ObstacleValues> read_obstacles(const Node& scenario);

}  // namespace hlc::scenario
