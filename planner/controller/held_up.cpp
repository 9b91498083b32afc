#include "planner/controller/held_up.hpp"

#include <algorithm>
#include <cmath>

#include "planner/common/demand.hpp"

namespace hlc::controller {

std::optional<double> held_up_at_m(const coordination::Plan& plan, StepIndex next,
                                   const search::HorizonProblem& problem,
                                   const RouteTracker& tracker, double reach_m) {
  const double s_m = tracker.s_m().value();
  const double length_m = tracker.route().path.length_m();
  const auto counted_on_m = [&](const Point& position_m) {
    return s_m + std::remainder(tracker.project(position_m, reach_m) - s_m, length_m);
  };
  const double end_s_m = counted_on_m(plan.pose_at(std::max(plan.end(), next)).position_m());
  if (counted_on_m(problem.reference_m.back()) - end_s_m < kHeldUp_m) return std::nullopt;
  return end_s_m;
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
