#pragma once

#include <string>
#include <vector>

#include "planner/road/lanelet_map.hpp"

namespace hlc::road {

/// A circuit of a map, by name.
struct NamedRoute {
  std::string name;
  std::vector<LaneletId> lanelets;
};

/// A road network with the circuits that can be driven on it.
struct RoadNetwork {
  LaneletMap map;
  std::vector<NamedRoute> routes;
};

/// A map of 4.5 m x 4.0 m of the same shape as the lab's: the circuits `red` (12.2 m), `blue` (9.2
/// m) and `green` (8.9 m), all lanes 0.150 m wide, their points about 5 cm apart.
///
/// The circuits come from curvature knots that fit the lab's centre lines within 5 mm (with the
/// following changes, within 8 mm). Red's second half is its first half turned by pi about (2.25,
/// 2.0). Where blue or green drives in red's lane, both use red's lanelet; where it drives beside
/// red, its lanelet is red's shifted by the lane width; the stretches between are bent by some
/// millimetres so that they begin and end exactly there. Stretches with a second lane of the same
/// direction that is on no circuit have it as a separate lanelet.
///
/// Lanelets follow each other where both end points agree and are adjacent where they share a whole
/// bound. The same on every call.
[[nodiscard]] RoadNetwork lab_like_map();

}  // namespace hlc::road
