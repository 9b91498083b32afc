#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "planner/road/corridor.hpp"
#include "planner/road/driving_line.hpp"
#include "planner/road/goal.hpp"
#include "planner/road/reference_path.hpp"
#include "planner/road/speed_sections.hpp"

namespace hlc::road {

/// A route that a vehicle may take: its path and drivable area.
struct DrivableRoute {
  std::string name;
  ReferencePath path;
  Corridor corridor;
  DrivingLine driving_line{};  ///< to be followed; arc lengths are always those of the path
  std::uint32_t number{};      ///< in the run's conflict map, if it has one
  std::optional<Goal> goal{};  ///< in which the path ends; none: an open one leads to its end
  std::vector<SpeedSection> speed_sections{};
};

/// Placement of a vehicle on a route.
struct Placement {
  double s_m{};         ///< arc length of its place on the path
  double distance_m{};  ///< of its position to the path
  double turned_rad{};  ///< its heading minus the path's there, in (-pi, pi]
  /// How far its footprint reaches beyond the corridor on each side; negative: room left. Minus
  /// infinity where the corridor has no bounds.
  double beyond_left_m{};
  double beyond_right_m{};
  bool is_on_ground{true};  ///< the whole footprint lies on the map

  /// On the side where it reaches farthest.
  [[nodiscard]] double beyond_m() const;
};

/// A placement fits if the footprint reaches at most kFitsBeyond_m beyond the drivable lanes and is
/// on the map, and the heading differs from the lane's by at most kFitsTurned_rad. On open ground,
/// which has no lanes, every pose fits.
///
/// 0.15 m is a lane's width, so that a car that stands between two routes fits the nearer one; 0.6
/// rad is an error that a car can correct within a lane's width or two.
inline constexpr double kFitsBeyond_m = 0.15;
inline constexpr double kFitsTurned_rad = 0.6;
[[nodiscard]] bool fits(const Placement& placement, const DrivableRoute& route);

/// The best place of the pose on the route: the one with the smallest
///
///     distance + 0.1 m * |turned|,
///
/// the mean of the errors of position and front. Where two strands cross or run side by side in
/// opposite directions it is the one in the vehicle's direction. Where the path drives a lane more
/// than once (reference_path.hpp), it is the first one, though another one may be better by up to
/// kSameLane_m.
///
/// A vehicle whose former place is known is on a piece that begins within kNearBy_m, unless a
/// place elsewhere is better by more than kElsewhere_m: someone has moved it. Where two lanes part
/// a vehicle that stands askew fits the wrong one better, and a random tour drives that one, too,
/// perhaps a hundred metres on; at the end of an open path it may fit the begin.
/// @param pose      the planner's (heading, not yaw)
/// @param from_s_m  on a closed path counted on over its ends; none: the former place is not known
[[nodiscard]] Placement placement_on(const DrivableRoute& route, const Pose& pose,
                                     const Footprint& footprint,
                                     std::optional<double> from_s_m = std::nullopt);

/// About five cars' lengths; as the next, of the lab's car, for others scale_of times as long.
inline constexpr double kNearBy_m = 1.0;
/// A lane's width.
inline constexpr double kElsewhere_m = 0.15;

/// The measure above for comparing places [m].
[[nodiscard]] double placement_cost_m(const Placement& placement);

/// By how much the drivable area is widened on each side, and where.
struct Widening {
  double from_s_m{};
  double to_s_m{};  ///< >= from_s_m; both meant modulo the length of a closed route
  double left_m{};
  double right_m{};
};

/// The route's corridor with every point of its bounds with s in [from, to] moved outwards, across
/// the path's direction at its s, by the side's width, but not beyond the ground: an area that
/// contains the corridor, is closed like it and lies on the map where the corridor does.
[[nodiscard]] Corridor widened(const DrivableRoute& route, const Widening& widening);

}  // namespace hlc::road
