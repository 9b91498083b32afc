#include "planner/scenario/obstacle_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/scenario/area_values.hpp"

namespace hlc::scenario {

std::vector<ObstacleValues> read_obstacles(const Node& scenario) {
  std::vector<ObstacleValues> obstacles;
  const std::vector<Node> entries = scenario.optional_list("obstacles");
  if (entries.size() > kMostObstacles) {
    scenario.fail("obstacles",
                  fmt::format("a list of at most {}, got {}", kMostObstacles, entries.size()));
  }
  for (const Node& node : entries) {
    node.check_keys({"name", "rectangle", "circle", "polygon"});
    const auto name = node.required<std::string>("name");
    if (name.empty()) node.fail("name", "not empty");
    if (std::ranges::find(obstacles, name, &ObstacleValues::name) != obstacles.end()) {
      node.fail("name", "unique");
    }
    obstacles.push_back({.name = name, .area_m = read_area(node), .node = node});
  }
  return obstacles;
}

}  // namespace hlc::scenario
