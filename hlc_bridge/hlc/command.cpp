#include "hlc_bridge/hlc/command.hpp"

#include <algorithm>
#include <cmath>

#include "planner/controller/command_time.hpp"

namespace hlc::high_level_controller {
namespace {

static_assert(kCommandLifetime == 1e9 * controller::kCommandLifetime_s &&
              kCopyDelay == 1e9 * controller::kCopyDelay_s);

/// Extra time for a list that arrives at the begin of its step.
constexpr double kReachReserve_s = 0.09;

}  // namespace

TrajectoryCommand command_of(VehicleId vehicle, const coordination::Plan* plan, StepIndex step,
                             Nanoseconds t_now, Nanoseconds period,
                             const vehicle::VehicleParameters& parameters, double interval_s,
                             std::size_t num_copies) {
  TrajectoryCommand command{
      .vehicle_id = vehicle.value, .create_stamp = t_now, .valid_after_stamp = t_now};
  if (plan == nullptr) {
    command.valid_after_stamp += followed_ns(num_copies);
    return command;
  }
  const auto step_start = static_cast<std::int64_t>(step.value * period);
  const double step_s = 1e-9 * static_cast<double>(period);
  const double offset_s = 1e-9 * static_cast<double>(static_cast<std::int64_t>(t_now) - step_start);
  // After valid_after: until then the last copy is usable, including the vehicle's look-ahead.
  const double usable_s = 1e-9 * static_cast<double>(followed_ns(num_copies) + kLookAhead);
  const double reach_s = usable_s + std::max(kReachReserve_s, offset_s);
  for (const TimedPoint& sample :
       controller::sample_trajectory(*plan, step, interval_s, reach_s, step_s, parameters)) {
    const std::int64_t t = step_start + std::llround(1e9 * sample.time_s);
    if (t < 0) continue;  // logical time starts at 0
    command.points.push_back({.t = static_cast<Nanoseconds>(t),
                              .x_m = sample.position_m.x(),
                              .y_m = sample.position_m.y(),
                              .vx_mps = sample.velocity_mps.x(),
                              .vy_mps = sample.velocity_mps.y()});
  }
  return command;
}

TrajectoryCommand copy_for_later(const TrajectoryCommand& command, std::size_t number) {
  TrajectoryCommand copy = command;
  copy.valid_after_stamp += number * kCopyDelay;
  return copy;
}

Nanoseconds followed_ns(std::size_t num_copies) {
  return kCommandLifetime + num_copies * kCopyDelay;
}

}  // namespace hlc::high_level_controller
