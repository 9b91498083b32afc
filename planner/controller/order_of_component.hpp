#pragma once

#include <span>

#include "planner/controller/controller.hpp"

namespace hlc::controller {

/// Replaces the order in which the vehicles of a component plan, if the strategy of the run
/// compares orders by their plans (coordination::PriorityStrategy::search): plans in one order
/// after the other; each then keeps its plan in the best one (Controller::keep_plan), which takes
/// no second search. The result depends on the members' states only; so controllers that put the
/// same replicas together (joint_planning.hpp) choose the same order.
/// @param component  controllers of all vehicles of one component, sorted by vehicle, each after
/// `couple` or `resume`, with the same rule and traffic. Unless all are settled nothing happens.
void choose_order(std::span<Controller* const> component);

}  // namespace hlc::controller
