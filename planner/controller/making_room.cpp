#include "planner/controller/making_room.hpp"

namespace hlc::controller {

void desired_plans_of_predecessors(const CoupledVehicle& other, StepIndex step,
                                   std::vector<ConvexPolygon>& areas_m) {
  if (!other.is_predecessor) {
    const StepIndex next{other.traffic->step.value + 1};
    if (step == next) areas_m.push_back(other.traffic->running.during(step));
    return;
  }
  if (other.prediction == nullptr) {
    areas_m.push_back(other.traffic->reachable_area_m);
    return;
  }
  areas_m.push_back(other.prediction->areas.during(step));
  if (other.prediction->desired) areas_m.push_back(other.prediction->desired->during(step));
}

search::HorizonProblem making_room(search::HorizonProblem problem,
                                   const std::vector<const coordination::OccupiedAreas*>& desired,
                                   StepIndex next, std::size_t from) {
  problem.obstacles_m.resize(problem.horizon_steps());
  for (std::size_t j = from; j < problem.horizon_steps(); ++j) {
    for (const coordination::OccupiedAreas* areas : desired) {
      problem.obstacles_m[j].push_back(areas->during({next.value + j}));
    }
  }
  return problem;
}

}  // namespace hlc::controller
