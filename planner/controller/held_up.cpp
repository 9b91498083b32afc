#include "planner/controller/held_up.hpp"

#include <algorithm>
#include <cmath>

#include "planner/common/demand.hpp"
#include "planner/controller/plan_end.hpp"

namespace hlc::controller {

std::optional<double> held_up_at_m(const coordination::Plan& plan, StepIndex next,
                                   const search::HorizonProblem& problem,
                                   const RouteTracker& tracker, double reach_m) {
  const double end_m = end_s_m(plan, next, tracker, reach_m);
  const double reference_m = tracker.project(problem.reference_m.back(), reach_m);
  const double left_m = std::remainder(reference_m - end_m, tracker.route().path.length_m());
  if (left_m < kHeldUp_m) return std::nullopt;
  return end_m;
}

search::HorizonProblem with_reference_of(search::HorizonProblem problem,
                                         const search::HorizonProblem& other) {
  HLC_DEMAND(problem.horizon_steps() == other.horizon_steps(), problem.horizon_steps(),
             other.horizon_steps());
  problem.reference_m = other.reference_m;
  problem.reference_speed_mps = other.reference_speed_mps;
  problem.contouring = other.contouring;
  return problem;
}

}  // namespace hlc::controller
