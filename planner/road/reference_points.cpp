#include "planner/road/reference_points.hpp"

#include <cassert>

namespace hlc {

Reference reference_points(const ReferencePath& path, double start_s_m, double current_speed_mps,
                           double reference_speed_mps, std::size_t horizon_steps, double step_s,
                           ReferenceRule rule) {
  assert(horizon_steps >= 1 && step_s > 0.0 && reference_speed_mps >= 0.0);
  Reference reference;
  reference.speeds_mps.assign(horizon_steps, reference_speed_mps);
  if (rule == ReferenceRule::k2022) {
    reference.speeds_mps.back() = reference_speed_mps / 2.0;
  } else {
    reference.speeds_mps.front() = (current_speed_mps + reference_speed_mps) / 2.0;
  }
  reference.points_m.reserve(horizon_steps);
  double s_m = start_s_m;
  for (const double speed_mps : reference.speeds_mps) {
    s_m += speed_mps * step_s;
    reference.points_m.push_back(path.at(s_m));
  }
  return reference;
}

}  // namespace hlc
