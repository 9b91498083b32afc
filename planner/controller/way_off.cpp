#include "planner/controller/way_off.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "planner/controller/plan_end.hpp"
#include "planner/geometry/footprint.hpp"

namespace hlc::controller {
namespace {

// Lengths for the µCar, for others scale_of times as long.

/// From step to step of the reference: slow enough for tight bends.
constexpr double kWayOfStep_m = 0.08;
/// A path that leads at least so far has got away: about a step of driving off.
constexpr double kAway_m = 0.05;
/// Whose middle is farther than this from the end is not beside it.
constexpr double kNear_m = 0.7;
/// Whose middle is at most so far beside the path is on it.
constexpr double kBesidePath_m = 0.07;

Point middle_m(const ConvexPolygon& area_m) {
  Point sum = Point::Zero();
  for (const Point& corner : area_m.vertices_m) sum += corner;
  return sum / static_cast<double>(area_m.vertices_m.size());
}

}  // namespace

std::optional<search::HorizonProblem> way_off_problem(const coordination::Plan& plan,
                                                      const search::HorizonProblem& found_in,
                                                      StepIndex next, const RouteTracker& tracker,
                                                      double reach_m,
                                                      const vehicle::VehicleParameters& vehicle) {
  if (found_in.obstacles_m.empty()) return std::nullopt;
  const double scale = scale_of(vehicle.footprint);
  const road::ReferencePath& path = tracker.route().path;
  const StepIndex end = std::max(plan.end(), next);
  const Pose& end_pose = plan.pose_at(end);
  const double from_m = end_s_m(plan, next, tracker, reach_m);
  std::vector<ConvexPolygon> beside_m;
  std::ranges::copy_if(found_in.obstacles_m.back(), std::back_inserter(beside_m),
                       [&](const ConvexPolygon& area_m) {
                         if (area_m.empty()) return false;
                         const Point at_m = middle_m(area_m);
                         if ((at_m - end_pose.position_m()).norm() > scale * kNear_m) return false;
                         const double s_m = tracker.project(at_m, reach_m + scale * kNear_m);
                         const bool is_ahead = std::remainder(s_m - from_m, path.length_m()) > 0.0;
                         return !is_ahead || (path.at(s_m) - at_m).norm() > scale * kBesidePath_m;
                       });
  if (beside_m.empty()) return std::nullopt;
  search::HorizonProblem problem{.start = end_pose, .start_trim = plan.trim_at(end)};
  for (std::size_t j = 0; j < found_in.horizon_steps(); ++j) {
    problem.reference_m.push_back(
        path.at(from_m + scale * kWayOfStep_m * static_cast<double>(j + 1)));
  }
  problem.reference_speed_mps = found_in.reference_speed_mps;
  problem.obstacles_m.assign(found_in.horizon_steps(), beside_m);
  problem.boundary_m = found_in.boundary_m;
  return problem;
}

bool may_lead_off(const search::SearchResult& result, const search::HorizonProblem& way_off,
                  const vehicle::VehicleParameters& vehicle) {
  if (result.status == search::SearchStatus::kBudget || result.reason == search::NoPath::kBudget) {
    return true;
  }
  if (result.poses.empty()) return false;
  const Point way_m = result.poses.back().position_m() - way_off.start.position_m();
  return way_m.norm() > scale_of(vehicle.footprint) * kAway_m;
}

}  // namespace hlc::controller
