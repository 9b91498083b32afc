#include "planner/controller/controller_options.hpp"

namespace hlc::controller {

std::vector<const automaton::Maneuver*> rest_of_plan_in_force(const coordination::Plan& in_force,
                                                              StepIndex next,
                                                              std::size_t horizon_steps) {
  std::vector<const automaton::Maneuver*> maneuvers;
  maneuvers.reserve(horizon_steps);
  for (std::size_t j = 0; j < horizon_steps; ++j) {
    maneuvers.push_back(&in_force.maneuver_during({next.value + j}));
  }
  return maneuvers;
}

std::vector<const automaton::Maneuver*> no_incumbent(const coordination::Plan& /*in_force*/,
                                                     StepIndex /*next*/,
                                                     std::size_t /*horizon_steps*/) {
  return {};
}

}  // namespace hlc::controller
