#include "planner/controller/lane_entry.hpp"

#include <algorithm>
#include <array>

namespace hlc::controller {
namespace {

constexpr std::array kExtra_m{0.0, 0.025, 0.05, 0.075, 0.1};
/// The area contains the footprint with this margin.
constexpr double kReserve_m = 0.001;
/// A plan that leads less far, as a share of the wanted and drivable length, is a dead end.
constexpr double kDrivesOff = 0.3;
/// A plan that leads at least this far moves.
constexpr double kMoves_m = 0.05;

bool crosses(const automaton::Maneuver& maneuver, const Pose& start,
             std::span<const Segment> boundary_m) {
  const ConvexPolygon area = transformed(maneuver.lane_area_m, start);
  return std::ranges::any_of(boundary_m,
                             [&area](const Segment& piece) { return intersects(area, piece); });
}

double length_m(std::span<const Point> points_m) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points_m.size(); ++i) {
    length_m += (points_m[i] - points_m[i - 1]).norm();
  }
  return length_m;
}

double led_m(const search::SearchResult& found, const Pose& start) {
  if (found.status == search::SearchStatus::kFallback) return 0.0;
  return (found.poses.back().position_m() - start.position_m()).norm();
}

bool used_up_budget(const search::SearchResult& found) {
  return found.status == search::SearchStatus::kBudget || found.reason == search::NoPath::kBudget;
}

/// True if the plan drives off and its last maneuver lies in the lanes.
bool leads_in(const search::SearchResult& found, const Pose& start, double drives_off_m,
              std::span<const Segment> lanes_m, const road::DrivableRoute& route,
              const Footprint& footprint) {
  if (led_m(found, start) < std::max(drives_off_m, kMoves_m)) return false;
  const std::size_t n = found.maneuvers.size();
  const Pose& before = n > 1 ? found.poses[n - 2] : start;
  return !crosses(*found.maneuvers.back(), before, lanes_m) &&
         lies_inside(route, found.poses.back(), footprint);
}

}  // namespace

LaneEntry find_lane_entry(
    const road::DrivableRoute& route, const road::Placement& placement, const Pose& start,
    double reach_m, const Footprint& footprint,
    const std::function<search::HorizonProblem(const road::Corridor&)>& pose_problem,
    const std::function<search::SearchResult(const search::HorizonProblem&)>& search) {
  if (route.corridor.bounds().empty()) return {};
  const search::HorizonProblem in_lanes = pose_problem(route.corridor);
  const double drives_off_m = kDrivesOff * std::min(length_m(in_lanes.reference_m), reach_m);
  bool may_move_in_lanes = false;
  bool is_certain = true;
  if (placement.beyond_m() <= 0.0) {
    const search::SearchResult found = search(in_lanes);
    if (leads_in(found, start, drives_off_m, in_lanes.boundary_m, route, footprint)) return {};
    is_certain = !used_up_budget(found);
    may_move_in_lanes = led_m(found, start) >= kMoves_m || used_up_budget(found);
  }
  for (const double extra_m : kExtra_m) {
    const auto by = [extra_m](double beyond_m) {
      return std::max(0.0, beyond_m + kReserve_m) + extra_m;
    };
    const road::Widening widening{.from_s_m = placement.s_m - kEntryBack_m,
                                  .to_s_m = placement.s_m + kEntryAhead_m,
                                  .left_m = by(placement.beyond_left_m),
                                  .right_m = by(placement.beyond_right_m)};
    road::Corridor area = road::widened(route, widening);
    const search::SearchResult found = search(pose_problem(area));
    if (leads_in(found, start, drives_off_m, in_lanes.boundary_m, route, footprint)) {
      return {.area = std::move(area), .widening = widening};
    }
    is_certain = is_certain && !used_up_budget(found);
  }
  return {.is_possible = may_move_in_lanes, .is_certain = is_certain, .area = std::nullopt};
}

bool lies_inside(const road::DrivableRoute& route, const Pose& pose, const Footprint& footprint) {
  return road::placement_on(route, pose, footprint).beyond_m() < footprint.width_m / 2.0;
}

bool keeps_to(const coordination::Plan& plan, StepIndex from, std::span<const Segment> boundary_m) {
  for (StepIndex step = from; step <= std::max(plan.end(), from); ++step.value) {
    if (crosses(plan.maneuver_during(step), plan.pose_at(step), boundary_m)) return false;
  }
  return true;
}

}  // namespace hlc::controller
