#include "planner/controller/route_tracker.hpp"

#include <algorithm>
#include <utility>

#include "planner/common/demand.hpp"

namespace hlc::controller {
namespace {

/// The path is searched this far behind the last projection, for a vehicle that was moved a little.
constexpr double kProjectionBack_m = 0.3;

/// A route that the vehicle fits is better than any that it does not fit.
constexpr double kUnfitCost_m = 1e6;

}  // namespace

RouteTracker::RouteTracker(std::shared_ptr<const std::vector<road::DrivableRoute>> routes)
    : routes_(std::move(routes)) {
  HLC_DEMAND(!routes_->empty());
}

void RouteTracker::resume(std::size_t route, double s_m) {
  HLC_DEMAND(route < routes_->size(), route, routes_->size());
  route_ = route;
  s_m_ = s_m;
}

void RouteTracker::select_route(const Pose& pose, const Footprint& footprint) {
  std::optional<double> least_m;
  for (std::size_t i = 0; i < routes_->size(); ++i) {
    const road::DrivableRoute& route = (*routes_)[i];
    const road::Placement placement = road::placement_on(route, pose, footprint);
    const double cost_m =
        road::placement_cost_m(placement) + (road::fits(placement, route) ? 0.0 : kUnfitCost_m);
    if (least_m && cost_m >= *least_m) continue;
    least_m = cost_m;
    route_ = i;
    placement_ = placement;
  }
  s_m_ = placement_->s_m;
}

road::Placement RouteTracker::place(const Pose& pose, const Footprint& footprint) {
  std::optional<double> from_s_m;
  if (s_m_) from_s_m = *s_m_ - kProjectionBack_m;
  road::Placement placement = road::placement_on(route(), pose, footprint, from_s_m);
  s_m_ = placement.s_m;
  return placement;
}

void RouteTracker::note_place(const Pose& pose, bool stays, StepIndex step,
                              std::size_t patience_steps, const Footprint& footprint) {
  if (noted_ != pose) {
    noted_ = pose;
    noted_since_ = step;
  }
  const bool stands = stays || step.value >= noted_since_.value + patience_steps;
  const bool is_there =
      s_m_ && road::is_at_goal(route().path, route().goal, *s_m_, pose, footprint);
  if (!is_there) {
    arrived_since_.reset();
  } else if (stands && !arrived_since_) {
    arrived_since_ = step;
  }
}

double RouteTracker::project(const Point& position_m, double reach_m) const {
  const road::ReferencePath& path = route().path;
  if (!s_m_) return path.project(position_m).s_m;
  return path
      .project_within(position_m, *s_m_ - kProjectionBack_m, *s_m_ + reach_m + kProjectionBack_m)
      .s_m;
}

}  // namespace hlc::controller
