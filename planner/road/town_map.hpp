#pragma once

#include "planner/road/lanelet_map.hpp"

namespace hlc::road {

/// Size of a town: crossings with four arms, `columns` from west to east, `rows` from south to
/// north.
struct Blocks {
  int columns{};
  int rows{};

  static constexpr int kMost = 12;  ///< of each
};

/// A town: columns x rows crossings with four arms on a square grid, and a road around them into
/// which their outer arms lead. Every road has one lane of 0.150 m in each direction, traffic keeps
/// to the right, and of every lane one may go straight on, left and right where there is an arm: so
/// every lane can be reached from every other one.
///
/// Crossings, and the junctions and bends of the road around them, lie 2.4 m apart. Between two of
/// them a lane is two lanelets of 0.55 m. The lanes across a crossing are straight, or turns of 90
/// degrees whose curvature rises, stays and falls evenly: at most 2.1 1/m to the right, 1.6 1/m to
/// the left. Between the two directions 50 mm are left free: without them, cars that came out of a
/// left turn a little askew stood between the kerb and a car that waited to enter the crossing.
///
/// The same on every call. @pre both numbers in 1 ... Blocks::kMost
[[nodiscard]] LaneletMap town_map(Blocks blocks);

}  // namespace hlc::road
