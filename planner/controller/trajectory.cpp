#include "planner/controller/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "planner/common/demand.hpp"

namespace hlc::controller {
std::vector<TimedPoint> sample_trajectory(const coordination::Plan& plan, StepIndex step,
                                          double interval_s, double until_s, double step_s,
                                          const vehicle::VehicleParameters& vehicle) {
  const auto per_step = static_cast<std::int64_t>(std::llround(step_s / interval_s));
  HLC_DEMAND(per_step > 0, step_s, interval_s);
  std::vector<TimedPoint> samples;
  if (step > plan.first()) {
    const StepIndex before{step.value - 1};
    samples.push_back(vehicle::timed_point(
        -interval_s, plan.state_at(before, step_s - interval_s, vehicle), vehicle));
  } else {
    TimedPoint sample =
        vehicle::timed_point(-interval_s, plan.state_at(step, 0.0, vehicle), vehicle);
    sample.position_m -= interval_s * sample.velocity_mps;
    samples.push_back(sample);
  }
  const std::uint64_t end = std::max(plan.end(), step).value - step.value;
  const std::int64_t count = std::max(static_cast<std::int64_t>(end) * per_step + 1,
                                      static_cast<std::int64_t>(std::ceil(until_s / interval_s)));
  for (std::int64_t i = 0; i <= count; ++i) {
    const StepIndex at{step.value + static_cast<std::uint64_t>(i / per_step)};
    const double rest_s = static_cast<double>(i % per_step) * interval_s;
    samples.push_back(vehicle::timed_point(static_cast<double>(i) * interval_s,
                                           plan.state_at(at, rest_s, vehicle), vehicle));
  }
  return samples;
}

}  // namespace hlc::controller
