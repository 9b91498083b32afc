#pragma once

#include <set>
#include <string>
#include <string_view>

#include "planner/road/lanelet_map.hpp"

namespace hlc::road {

/// The lanelets of a CommonRoad file that cars may drive: those without users, or with `vehicle` or
/// `car` among them (<userOneWay>, <userBidirectional>), whose <laneletType> is none of sidewalk,
/// crosswalk, bicycleLane, busLane, busStop, shoulder and border.
///
/// Refused by their names are traffic rules that no car regards: in a lanelet <stopLine>,
/// <speedLimit>, references to signs and lights, a line towards a neighbour of the same direction
/// that is not dashed, broad_dashed, no_marking or unknown, since cars would cross it, and every
/// element and type that is not known here; in the file every element but lanelets, intersections
/// (which state how lanelets cross, not who goes first), obstacles (map_obstacles.hpp), planning
/// problems, location and tags.
/// @throws std::runtime_error one line, `file:line: fault and bound`
[[nodiscard]] std::set<LaneletId> parse_lanelets_for_cars(std::string_view xml,
                                                          const std::string& name);

}  // namespace hlc::road
