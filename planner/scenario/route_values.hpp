#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/common/node.hpp"
#include "planner/road/lanelet_map.hpp"

namespace hlc::scenario {

/// An entry of `sections`: lanelets of a route, one after the other, on which no reference is
/// faster.
struct SectionValues {
  road::LaneletId from{};  ///< the first one
  road::LaneletId to{};    ///< the last one; on a closed route perhaps before `from`
  double reference_speed_mps{};
  Node node;  ///< its place in the file, for messages
};

/// An entry of `routes`.
struct RouteValues {
  std::string name;
  bool is_closed{true};
  std::map<std::string, std::vector<road::LaneletId>> lanelets;  ///< by the benchmarkID of the map
  /// Likewise; none: no map has any.
  std::optional<std::map<std::string, std::vector<SectionValues>>> sections{};
  bool begins_elsewhere{};  ///< a route above, from another one of its lanelets on
  Node node;                ///< its place in the file, for messages
};

/// The list `routes` of a scenario.
/// @throws std::invalid_argument with one line, "file:line: key = value, must be ...": also for a
/// section whose lanelets the route does not drive, or drives twice, and for one that overlaps one
/// above
[[nodiscard]] std::vector<RouteValues> read_routes(const Node& scenario);

}  // namespace hlc::scenario
