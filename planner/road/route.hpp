#pragma once

#include <vector>

#include "planner/road/corridor.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/road/reference_path.hpp"
#include "planner/road/speed_sections.hpp"

namespace hlc::road {

/// The route of one vehicle: its path and drivable area.
struct Route {
  std::vector<LaneletId> lanelets;
  /// Centre line of the lanelets one after the other.
  ReferencePath path;
  /// Boundary of the drivable lanes: on each lanelet of the route, the lane itself and its
  /// neighbours of the same direction (neighbours of neighbours too). A lane without such a
  /// neighbour takes the one that begins beside it and merges into its end, or forks off its begin
  /// and ends beside it, with that lane's neighbours: such lanes overlap, and alone they are too
  /// narrow for a car (at the lab's curvature of 3 1/m, the rectangle of 0.107 m sweeps 0.15 m and
  /// more).
  ///
  /// The boundary is the left bound of the leftmost and the right bound of the rightmost of them as
  /// in the map, joined to those of the next lanelet by a piece across where they do not meet. The
  /// pieces hold the arc length on `path`.
  Corridor corridor;
  /// Arc length on `path` at which each lanelet of the route begins, and the end of the last.
  std::vector<double> lanelet_s_m;
  std::vector<SpeedSection> speed_sections{};  ///< the map knows none
};

/// Largest distance between the end of a lanelet and the begin of the next that counts as a joint
/// [m]; the path then runs through its midpoint.
inline constexpr double kMaxJointGap_m = 0.005;

/// @param lanelets  ids in the order of driving
/// @param closed    true if the last lanelet leads to the first (circuit)
/// @throws std::runtime_error one line: no lanelet, an unknown id, a lanelet whose end is more than
///         kMaxJointGap_m away from the begin of the next, a lanelet without length
[[nodiscard]] Route build_route(const LaneletMap& map, const std::vector<LaneletId>& lanelets,
                                bool closed);

}  // namespace hlc::road
