#pragma once

#include <vector>

#include "planner/geometry/pose.hpp"
#include "planner/road/curvature_curve.hpp"
#include "planner/road/lanelet_map.hpp"

namespace hlc::road {

// What the generated maps are made of: lines in the middle of a lane and their lanelets. The maps
// have the lab's size; mirrored and turned mean about the centre of the map, (2.25 m, 2.0 m).

inline constexpr double kLaneWidth_m = 0.150;

/// Points in the middle of a lane, about 5 cm apart, with the heading of travel.
using Line = std::vector<Pose>;
using Knots = std::vector<CurvatureCurve::Knot>;

/// The pose moved across its heading.
[[nodiscard]] Pose shifted(const Pose& pose, double left_m);

/// Turned by pi about the centre of the map.
[[nodiscard]] Pose turned(const Pose& pose);
[[nodiscard]] Line turned(Line line);

/// The same points, driven in the opposite direction.
[[nodiscard]] Line driven_back(Line line);

/// The mirror image about the vertical (`x`) or horizontal (`y`) centre line of the map, driven in
/// the opposite direction, so that driving stays clockwise and on the right.
[[nodiscard]] Line mirrored_x(Line line);
[[nodiscard]] Line mirrored_y(Line line);

/// The line, bent so that it begins at pose `begin` and ends at pose `end`: a cubic Hermite
/// polynomial adds the missing position and direction. @pre points evenly spaced
[[nodiscard]] Line bent(Line line, const Pose& begin, const Pose& end);

/// The curve from `from_s_m` to `to_s_m`, bent to `begin` and `end`.
[[nodiscard]] Line stretch(const CurvatureCurve& curve, double from_s_m, double to_s_m,
                           const Pose& begin, const Pose& end);

/// The lane whose middle runs `left_m` to the left of the line, kLaneWidth_m wide, without
/// relations to others.
[[nodiscard]] Lanelet lane_along(const Line& line, LaneletId id, double left_m = 0.0);

/// Finds successors, predecessors and neighbours from the bounds: lanelets follow each other where
/// both end points agree, and are neighbours where they share a whole bound, driven in the same or
/// in the opposite direction.
void link(LaneletMap& map);

}  // namespace hlc::road
