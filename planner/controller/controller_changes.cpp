// What the owner of a controller may change between two steps.
#include <algorithm>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/controller/controller.hpp"
#include "planner/controller/planning_basis.hpp"

namespace hlc::controller {

void Controller::set_max_expansions(std::size_t max_expansions) {
  options_.search.max_expansions = max_expansions;
  search_.set_max_expansions(max_expansions);
}

void Controller::set_reference_speed(double speed_mps) {
  HLC_DEMAND(speed_mps > 0.0, speed_mps);
  options_.reference_speed_mps = speed_mps;
}

void Controller::coordinate_by(const coordination::PriorityRule& priorities,
                               const CoordinationRule& rule) {
  options_.strategies.priorities = priorities;
  options_.strategies.coordination = rule;
}

void Controller::switch_to(const PreparedSubgraph& next) {
  search_.switch_to(next, options_.search, last_step());
  drivable_area_.note_switch();
}

void Controller::switch_to(std::shared_ptr<const automaton::Subgraph> next) {
  switch_to(prepare_subgraph(std::move(next), options_.horizon_steps, options_.search));
}

void Controller::change_route(road::DrivableRoute next) {
  HLC_DEMAND(has_plan());
  HLC_DEMAND(!options_.conflicts || next.number < options_.conflicts->num_routes(), next.number);
  tracker_ = RouteTracker(std::make_shared<const std::vector<road::DrivableRoute>>(
      std::vector<road::DrivableRoute>{std::move(next)}));
  tracker_.select_route(plan_in_force().pose_at({last_step().value + 1}),
                        subgraph().automaton().vehicle.footprint);
  drivable_area_.change_route();
  routes_digest_ = digest_of(tracker_.routes());
}

bool Controller::will_meet(const ConvexPolygon& area_m) const {
  const coordination::OccupiedAreas areas = in_force_->announced_areas({last_step().value + 1});
  const auto meets = [&area_m](const ConvexPolygon& one) { return intersects(one, area_m); };
  return std::ranges::any_of(areas.areas_m, meets) || meets(areas.final_area_m);
}

}  // namespace hlc::controller
