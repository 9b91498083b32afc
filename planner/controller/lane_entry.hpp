#pragma once

#include <functional>
#include <optional>
#include <span>

#include "planner/coordination/plan.hpp"
#include "planner/road/placement.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::controller {

/// The area in which a vehicle may drive that stands beside its lanes, or so askew in them that no
/// plan within them drives off, until it is in them.
///
/// No plan from beside the lanes stays in them, since not even its begin does. So the area is the
/// route's corridor, widened (placement.hpp) from kEntryBack_m behind the vehicle to kEntryAhead_m
/// before it, on each side by
///
///     max(0, how far the footprint reaches beyond that side now) + e,
///
/// with the smallest e of 0, 25, 50, 75 and 100 mm for which the best plan, without any other
/// vehicle, drives off and ends with its footprint in the lanes. It drives off if it leads at least
/// 0.3 of the reference's length over the horizon, or of the drivable length if that is less: a
/// shorter one is a dead end. (The front swings out farther while a vehicle that points outwards
/// turns back.) If there is none for any e, the automaton cannot get from there onto the route: the
/// vehicle stays in place, e.g. at the edge of the map with the front towards it. If it can move in
/// its lanes, or a search used up its budget before that was known, it has the plain corridor then.
///
/// The area is fixed when the vehicle departs, and is as hard a constraint as the corridor, so
/// every plan in it can be driven to its end. It is replaced by the plain corridor as soon as the
/// plan in force lies in that from the next step on. It lies on the map; other vehicles are
/// obstacles as always.
struct LaneEntry {
  bool is_possible{true};
  bool is_certain{true};               ///< if it is impossible: no search used up its budget
  std::optional<road::Corridor> area;  ///< none: the plain corridor
  road::Widening widening{};           ///< by which the area came from the corridor
};

inline constexpr double kEntryBack_m = 0.5;
inline constexpr double kEntryAhead_m = 0.8;

/// @param start         standing; its `placement` on the route
/// @param reach_m       largest distance that can be driven in the horizon from there
/// @param pose_problem  makes the search problem from there in a corridor, without other vehicles
/// @param search        called up to six times
[[nodiscard]] LaneEntry find_lane_entry(
    const road::DrivableRoute& route, const road::Placement& placement, const Pose& start,
    double reach_m, const Footprint& footprint,
    const std::function<search::HorizonProblem(const road::Corridor&)>& pose_problem,
    const std::function<search::SearchResult(const search::HorizonProblem&)>& search);

/// Whether a footprint that crosses no bound lies in the lanes. It may also stand wholly beside
/// them, farther away than it is wide.
[[nodiscard]] bool lies_inside(const road::DrivableRoute& route, const Pose& pose,
                               const Footprint& footprint);

/// True if the plan's footprints from t(from) on cross none of the boundary's pieces.
[[nodiscard]] bool keeps_to(const coordination::Plan& plan, StepIndex from,
                            std::span<const Segment> boundary_m);

}  // namespace hlc::controller
