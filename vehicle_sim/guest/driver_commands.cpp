#include "vehicle_sim/guest/driver_commands.hpp"

#include <algorithm>

namespace hlc::guest {
namespace {

constexpr double kCurvatureShare = 0.8;
constexpr double kSpeedShare = 0.85;
constexpr double kAccelerationShare = 0.7;
constexpr double kRollOut_mps = 0.25;
constexpr double kTick_s = 1e-9 * static_cast<double>(kVehiclePeriod);

}  // namespace

DriverCommand DriverCommands::tick(Nanoseconds t_now, double speed_mps, double curvature_per_m) {
  if (speed_mps <= 0.0 && speed_mps_ <= kRollOut_mps) {
    rolls_until_ = t_now + kCommandLifetime;
    speed_mps_ = 0.0;
    return DirectCommand{
        .vehicle_id = vehicle_.value, .create_stamp = t_now, .valid_after_stamp = t_now};
  }
  const double tightest_per_m = kCurvatureShare * limits_.curvature_per_m;
  if (t_now >= rolls_until_) change_speed(speed_mps);
  return SpeedCurvatureCommand{
      .vehicle_id = vehicle_.value,
      .create_stamp = t_now,
      .valid_after_stamp = t_now,
      .speed_mps = speed_mps_,
      .curvature_per_m = std::clamp(curvature_per_m, -tightest_per_m, tightest_per_m)};
}

void DriverCommands::change_speed(double wanted_mps) {
  const double faster_mps = kAccelerationShare * limits_.acceleration_mps2 * kTick_s;
  const double slower_mps = kAccelerationShare * limits_.deceleration_mps2 * kTick_s;
  speed_mps_ = std::clamp(std::clamp(wanted_mps, 0.0, kSpeedShare * limits_.speed_mps),
                          speed_mps_ - slower_mps, speed_mps_ + faster_mps);
}

}  // namespace hlc::guest
