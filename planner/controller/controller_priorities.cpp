// What a controller announces for the priorities of a step, and another order after they are
// assigned.
#include "planner/common/demand.hpp"
#include "planner/controller/controller.hpp"
#include "planner/controller/problem_alone.hpp"

namespace hlc::controller {

std::vector<ConvexPolygon> Controller::reference_areas_m() const {
  if (!path_s_m()) return {};
  const double s_m = tracker_.project(step_.traffic.next_pose.position_m(), reach_m());
  return areas_on(reference_alone(step_.traffic, tracker_, s_m, subgraph(), options_, kNoEnd_m),
                  route().path, subgraph().automaton().vehicle);
}

void Controller::plan_in(const coordination::PriorityOrder& plans_before, std::uint32_t level) {
  step_.plans_before = plans_before;
  step_.predecessors = coordination::predecessors(coupling(), options_.vehicle, plans_before);
  step_.report.level = level;
}

Controller::Coupled Controller::coupled_state() const {
  HLC_DEMAND(search_.is_settled());
  return Coupled(step_, tracker_, drivable_area_);
}

void Controller::restore(const Coupled& state) {
  step_ = state.step_;
  tracker_ = state.tracker_;
  drivable_area_ = state.drivable_area_;
}

}  // namespace hlc::controller
