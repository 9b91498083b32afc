#include "planner/controller/joint_planning.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>

#include "planner/controller/order_of_component.hpp"

namespace hlc::controller {

std::vector<VehicleId> JointPlanning::prepare(const Controller& own) {
  std::vector<VehicleId> not_shared;
  std::ranges::copy_if(own.component(), std::back_inserter(not_shared),
                       [&](VehicleId vehicle) { return !can_plan(vehicle, own); });
  return not_shared;
}

bool JointPlanning::can_be_planned_for(const Controller& own,
                                       const coordination::Traffic& traffic) {
  if (!traffic.planning || !is_well_formed(*traffic.planning, traffic.step)) return false;
  const Controller* replica = replica_of(own.options().vehicle, own);
  return replica != nullptr && replica->planning_basis() == traffic.planning->basis;
}

Controller* JointPlanning::replica_of(VehicleId vehicle, const Controller& own) {
  std::unique_ptr<Controller>& replica = replicas_[vehicle];
  if (!replica) replica = others_(vehicle);
  const ControllerStrategies& rules = own.options().strategies;
  if (replica && replica->options().strategies != rules) {
    replica->coordinate_by(rules.priorities, rules.coordination);
  }
  if (replica) replica->take_obstacles_of(own);  // a fork may have added some
  return replica.get();
}

bool JointPlanning::can_plan(VehicleId vehicle, const Controller& own) {
  const coordination::Traffic& traffic = own.traffic_of(vehicle);
  if (!traffic.planning) return false;
  if (vehicle == own.options().vehicle) return true;
  Controller* replica = replica_of(vehicle, own);
  return replica != nullptr && replica->resume(traffic, own);
}

std::vector<VehicleId> JointPlanning::vehicles_that_matter(const Controller& own) const {
  const coordination::CouplingGraph& coupling = own.coupling();
  const coordination::PriorityOrder& plans_before = own.plans_before();
  std::vector<VehicleId> found{own.options().vehicle};
  std::ranges::copy(own.coupled(), std::back_inserter(found));
  std::set<VehicleId> known(found.begin(), found.end());
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const VehicleId before : predecessors(coupling, found[i], plans_before)) {
      if (known.insert(before).second) found.push_back(before);
    }
  }
  std::ranges::sort(found, std::cref(plans_before));
  return found;
}

coordination::ReceivedMessages<coordination::Prediction> JointPlanning::plan(Controller& own) {
  const auto controller_of = [&](VehicleId vehicle) {
    return vehicle == own.options().vehicle ? &own : replicas_.at(vehicle).get();
  };
  std::vector<Controller*> component;
  for (const VehicleId vehicle : own.component()) component.push_back(controller_of(vehicle));
  choose_order(component);
  coordination::ReceivedMessages<coordination::Prediction> predictions;
  for (const VehicleId vehicle : vehicles_that_matter(own)) {
    predictions.put(std::make_shared<const coordination::Prediction>(
        controller_of(vehicle)->plan(predictions)));
  }
  return predictions;
}

}  // namespace hlc::controller
