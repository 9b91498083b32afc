// What a controller announces for the priorities of a step, and another order after they are
// assigned.
#include <algorithm>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/controller/controller.hpp"
#include "planner/controller/problem_alone.hpp"

namespace hlc::controller {

std::vector<ConvexPolygon> Controller::reference_areas_m() const {
  if (!path_s_m()) return {};
  const double s_m = tracker_.project(step_.traffic.next_pose.position_m(), reach_m());
  return areas_on(
      reference_alone(step_.traffic, tracker_, s_m, subgraph(), options_, ReferenceEnd{}.s_m),
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

Controller::Coupled Controller::take_state() {
  return Coupled(std::move(step_), std::move(tracker_), std::move(drivable_area_));
}

void Controller::restore(Coupled state) {
  step_ = std::move(state.step_);
  tracker_ = std::move(state.tracker_);
  drivable_area_ = std::move(state.drivable_area_);
}

void Controller::keep_plan(std::shared_ptr<const Coupled> before) {
  step_.before_plan = std::move(before);
}

bool Controller::has_kept_plan_for(
    const coordination::ReceivedMessages<coordination::Prediction>& received) const {
  if (step_.before_plan == nullptr) return false;
  if (step_.respected.size() != step_.predecessors.size()) return false;
  return std::ranges::all_of(step_.predecessors, [&](VehicleId other) {
    const auto now = received.find(other, step_.observation.step);
    const auto then = step_.respected.find(other);
    return now != nullptr && then != step_.respected.end() && *now == *then->second;
  });
}

void Controller::drop_kept_plan() {
  if (step_.before_plan == nullptr) return;
  const std::shared_ptr<const Coupled> before = std::move(step_.before_plan);
  const coordination::PriorityOrder plans_before = std::move(step_.plans_before);
  const std::uint32_t level = step_.report.level;
  restore(*before);
  plan_in(plans_before, level);
}

}  // namespace hlc::controller
