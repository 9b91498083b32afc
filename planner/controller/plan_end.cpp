#include "planner/controller/plan_end.hpp"

#include <algorithm>
#include <cmath>

#include "planner/geometry/pose.hpp"
#include "planner/road/reference_path.hpp"

namespace hlc::controller {
namespace {

/// Half the length of the chord whose direction counts as the path's.
constexpr double kHalfLaneChord_m = 0.05;

/// Where a vehicle stands for good.
struct Stand {
  double s_m;  ///< arc length of its place on the path
  double turned_rad;
};

Stand stand_at_end(const coordination::Plan& plan, StepIndex next, const RouteTracker& tracker,
                   double reach_m) {
  const Pose& end = plan.pose_at(std::max(plan.end(), next));
  const double s_m = tracker.project(end.position_m(), reach_m);
  const double lane_rad = road::chord_heading_rad(tracker.route().path, s_m, kHalfLaneChord_m);
  return {s_m, std::abs(wrap_angle(end.heading_rad - lane_rad))};
}

}  // namespace

double turned_at_end_rad(const coordination::Plan& plan, StepIndex next,
                         const RouteTracker& tracker, double reach_m) {
  return stand_at_end(plan, next, tracker, reach_m).turned_rad;
}

bool ends_along_lane(const coordination::Plan& candidate, const coordination::Plan& in_force,
                     StepIndex next, const RouteTracker& tracker, double reach_m) {
  const Stand then = stand_at_end(candidate, next, tracker, reach_m);
  if (then.turned_rad <= kMostTurned_rad) return true;
  const Stand former = stand_at_end(in_force, next, tracker, reach_m);
  const double length_m = tracker.route().path.length_m();
  return then.turned_rad <= former.turned_rad ||
         std::remainder(then.s_m - former.s_m, length_m) >= kLeadsOn_m;
}

}  // namespace hlc::controller
