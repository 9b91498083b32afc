#include "planner/controller/set_off.hpp"

#include "planner/search/horizon_problem.hpp"

namespace hlc::controller {
namespace {

bool stands_during(const coordination::Plan& plan, StepIndex step) {
  const automaton::Maneuver& maneuver = plan.maneuver_during(step);
  return search::stands_in(maneuver) || search::turns_in_place(maneuver);
}

/// The first step from t(next) on in which the plan moves the vehicle; its end if none does.
StepIndex sets_off_at(const coordination::Plan& plan, StepIndex next) {
  StepIndex step = next;
  while (step < plan.end() && stands_during(plan, step)) ++step.value;
  return step;
}

}  // namespace

bool puts_off(const coordination::Plan& candidate, const coordination::Plan& in_force,
              StepIndex next) {
  if (!stands_during(in_force, {next.value - 1})) return false;
  const StepIndex was = sets_off_at(in_force, next);
  if (was >= in_force.end()) return false;  // it stands for good
  const StepIndex is = sets_off_at(candidate, next);
  return is > was || is >= candidate.end();
}

}  // namespace hlc::controller
