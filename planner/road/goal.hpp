#pragma once

#include <optional>

#include "planner/geometry/footprint.hpp"
#include "planner/road/reference_path.hpp"

/// Where an open path leads to: a vehicle that stands there has arrived.
namespace hlc::road {

/// A region in which a path ends.
struct Goal {
  ConvexPolygon area_m;
  double from_s_m{};  ///< arc length from which on the path is in it, until it ends
};

/// A piece of a path.
struct Stretch {
  double from_s_m{};
  double to_s_m{};  ///< >= from_s_m; on a closed path perhaps beyond its length
};

/// The first stretch of the path that enters the area after `start_s_m`, on a closed path within a
/// length; a stretch around the start itself does not count. None: the path does not enter it.
[[nodiscard]] std::optional<Stretch> first_stretch_in(const ReferencePath& path,
                                                      const ConvexPolygon& area_m,
                                                      double start_s_m);

/// The path from its begin to `end_s_m`, open; of a closed one also beyond its length, where places
/// are counted on. @pre end_s_m > 0, on an open path <= length
[[nodiscard]] ReferencePath path_until(const ReferencePath& path, double end_s_m);

/// Whether a vehicle that stands at the pose has arrived at the end of the path: its footprint
/// covers the end or, with a goal, its position is in the region. On a closed path never.
/// @param s_m  its place on the path: a region or an end that the path passes before does not count
[[nodiscard]] bool is_at_goal(const ReferencePath& path, const std::optional<Goal>& goal,
                              double s_m, const Pose& pose, const Footprint& footprint);

}  // namespace hlc::road
