#include "planner/controller/plan_end.hpp"

#include <algorithm>
#include <cmath>

#include "planner/geometry/pose.hpp"
#include "planner/road/reference_path.hpp"

namespace hlc::controller {
namespace {

/// Half the length of the chord whose direction counts as the path's.
constexpr double kHalfLaneChord_m = 0.05;

}  // namespace

double end_s_m(const coordination::Plan& plan, StepIndex next, const RouteTracker& tracker,
               double reach_m) {
  const double s_m = tracker.s_m().value();
  const Point end_m = plan.pose_at(std::max(plan.end(), next)).position_m();
  return s_m +
         std::remainder(tracker.project(end_m, reach_m) - s_m, tracker.route().path.length_m());
}

double turned_at_end_rad(const coordination::Plan& plan, StepIndex next,
                         const RouteTracker& tracker, double reach_m) {
  const Pose& end = plan.pose_at(std::max(plan.end(), next));
  const double s_m = tracker.project(end.position_m(), reach_m);
  const double lane_rad = road::chord_heading_rad(tracker.route().path, s_m, kHalfLaneChord_m);
  return std::abs(wrap_angle(end.heading_rad - lane_rad));
}

bool ends_along_lane(const coordination::Plan& candidate, const coordination::Plan& in_force,
                     StepIndex next, const RouteTracker& tracker, double reach_m) {
  const double turned_rad = turned_at_end_rad(candidate, next, tracker, reach_m);
  return turned_rad <= kMostTurned_rad ||
         turned_rad <= turned_at_end_rad(in_force, next, tracker, reach_m);
}

}  // namespace hlc::controller
