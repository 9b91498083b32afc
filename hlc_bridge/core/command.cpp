#include "hlc_bridge/core/command.hpp"

#include <cmath>

namespace hlc {
namespace {

/// The copy is usable until kCopyDelay + kCommandLifetime, and the vehicle looks 360 ms ahead.
constexpr double kReach_s = 1e-9 * static_cast<double>(kCopyDelay + kCommandLifetime) + 0.45;

}  // namespace

TrajectoryCommand command_of(VehicleId vehicle, const Plan* plan, StepIndex step, Nanoseconds t_now,
                             Nanoseconds period, const VehicleParameters& parameters,
                             double interval_s) {
  TrajectoryCommand command{
      .vehicle_id = vehicle.value, .create_stamp = t_now, .valid_after_stamp = t_now};
  if (plan == nullptr) return command;
  const auto step_start = static_cast<std::int64_t>(step.value * period);
  const double step_s = 1e-9 * static_cast<double>(period);
  for (const TimedPoint& sample :
       sample_trajectory(*plan, step, interval_s, kReach_s, step_s, parameters)) {
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

TrajectoryCommand copy_for_later(const TrajectoryCommand& command) {
  TrajectoryCommand copy = command;
  copy.valid_after_stamp += kCopyDelay;
  return copy;
}

}  // namespace hlc
