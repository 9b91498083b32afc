#include "planner/maneuver_design/maneuver_problem.hpp"

namespace hlc::maneuver_design {

vehicle::State start_state(const ManeuverProblem& problem) {
  return {Pose{}, problem.from.speed_mps, problem.from.steering_rad};
}

Channel speed_channel(const ManeuverProblem& p) {
  return {0,
          p.from.speed_mps,
          p.to.speed_mps,
          p.limits.acceleration_mps2,
          p.limits.speed_min_mps,
          p.limits.speed_max_mps};
}

Channel steering_channel(const ManeuverProblem& p) {
  return {1,
          p.from.steering_rad,
          p.to.steering_rad,
          p.limits.steering_rate_radps,
          -p.limits.steering_max_rad,
          p.limits.steering_max_rad};
}

}  // namespace hlc::maneuver_design
