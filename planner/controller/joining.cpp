#include "planner/controller/joining.hpp"

#include <algorithm>
#include <array>

namespace hlc {
namespace {

constexpr std::array kExtra_m{0.0, 0.025, 0.05, 0.075, 0.1};
/// The area holds the footprint with this to spare.
constexpr double kReserve_m = 0.001;
/// A plan drives off if it leads at least so far.
constexpr double kDrivesOff_m = 0.05;

bool crosses(const Maneuver& maneuver, const Pose& start, std::span<const Segment> boundary_m) {
  const ConvexPolygon area = transformed(maneuver.lane_area_m, start);
  return std::ranges::any_of(boundary_m,
                             [&area](const Segment& piece) { return intersects(area, piece); });
}

/// The plan drives off and its last maneuver lies in the lanes.
bool leads_in(const SearchResult& found, const Pose& start, std::span<const Segment> lanes_m) {
  if (found.status == SearchStatus::kFallback) return false;
  const std::size_t n = found.maneuvers.size();
  const Pose& before = n > 1 ? found.poses[n - 2] : start;
  const double driven_m = (found.poses.back().position_m() - start.position_m()).norm();
  return driven_m >= kDrivesOff_m && !crosses(*found.maneuvers.back(), before, lanes_m);
}

}  // namespace

Joining join(const DrivableRoute& route, const Placement& placement, const Pose& start,
             const std::function<HorizonProblem(const Corridor&)>& pose_problem,
             HorizonPlanner& planner) {
  if (route.corridor.bounds().empty()) return {};
  const bool is_in_lanes = placement.beyond_m() <= 0.0;
  const HorizonProblem in_lanes = pose_problem(route.corridor);
  if (is_in_lanes && leads_in(planner.plan(in_lanes), start, in_lanes.boundary_m)) return {};
  for (const double extra_m : kExtra_m) {
    const auto by = [extra_m](double beyond_m) {
      return std::max(0.0, beyond_m + kReserve_m) + extra_m;
    };
    Corridor area = widened(route, {.from_s_m = placement.s_m - kJoiningBack_m,
                                    .to_s_m = placement.s_m + kJoiningAhead_m,
                                    .left_m = by(placement.beyond_left_m),
                                    .right_m = by(placement.beyond_right_m)});
    if (leads_in(planner.plan(pose_problem(area)), start, in_lanes.boundary_m)) {
      return {.is_possible = true, .area = std::move(area)};
    }
  }
  return {.is_possible = is_in_lanes, .area = std::nullopt};
}

bool keeps_to(const Plan& plan, StepIndex from, std::span<const Segment> boundary_m) {
  for (StepIndex step = from; step <= std::max(plan.end(), from); ++step.value) {
    if (crosses(plan.maneuver_during(step), plan.pose_at(step), boundary_m)) return false;
  }
  return true;
}

}  // namespace hlc
