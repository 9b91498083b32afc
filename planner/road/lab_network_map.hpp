#pragma once

#include "planner/road/lanelet_map.hpp"

namespace hlc::road {

/// A map of 4.5 m x 4.0 m with the lab's whole road network: 104 lanelets, all 0.150 m wide, with
/// the lab's numbers and relations, so that a list of lanelets means the same way on both maps. A
/// two-lane clockwise ring, four arms of two lanes each way, an intersection with all movements.
///
/// The network is mirror symmetric about both centre lines of the map (the lab's to 0.2 mm).
/// Lanelets 1 to 26 are constructed; 27 to 52 are their mirror images about x = 2.25 m, 53 to 78
/// those about y = 2.0 m, 79 to 104 are turned by pi. A mirror image is driven the other way, so
/// that traffic keeps to the right and to clockwise. The 26 are six curves by curvature knots that
/// fit the lab's centre lines (all 104 within 2 mm), two straight lines, and lanes beside these:
///
///     ring, inner lane   1 3 5 7      outer lane to the left    2 4 6 8
///     ring to arm        9 11         second lane to the right  10 12
///     arm to ring        13 15        second lane to the right  14 16
///     changes of lane    22 23        (from 16 onto the ring, off the ring to 10)
///     right turn         25 18        left turn the other way   20 21
///     straight on        26 17 (westwards), 24 19 (northwards), half of the intersection each
///
/// The same on every call.
[[nodiscard]] LaneletMap lab_network_map();

}  // namespace hlc::road
