#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "planner/geometry/pose.hpp"
#include "planner/vehicle/identified_vehicle.hpp"

/// Motion of the lab's identified vehicle: one explicit Euler step of the model, its inverse, and
/// its stop law. The simulated vehicle moves by it and the on-board follower predicts with it, as
/// in the lab, where both have the same model.
namespace hlc::vehicle {

/// Length of one Euler step [s]: the vehicle's tick. The parameters were identified together with
/// it.
inline constexpr double kIdentifiedStep_s = 0.020;
/// Ticks between giving an input and its first effect (80 ms).
inline constexpr std::size_t kInputDelayTicks = 4;
/// Battery voltage of the simulation [V].
inline constexpr double kBatteryVoltage_v = 7.8;

/// Command to the vehicle: throttle f and steering s, both in [-1, 1]; steering positive to the
/// left.
struct ActuatorInput {
  double throttle{};
  double steering{};

  friend bool operator==(const ActuatorInput&, const ActuatorInput&) = default;
};

/// State of the identified model. Its heading is the lab's yaw; the course differs from it by the
/// slip.
struct VehicleMotion {
  Pose pose;
  double speed_mps{};  ///< v, the wheels' speed; the path's speed is p1 v (1 + p2 delta^2)

  friend bool operator==(const VehicleMotion&, const VehicleMotion&) = default;
};

/// What the actuators make of a finite `wanted` a tick after they were given `last`: each in [-1,
/// 1], the steering no further from the last one than the servo turns in a tick.
[[nodiscard]] inline ActuatorInput actuated(const ActuatorInput& wanted, const ActuatorInput& last,
                                            const IdentifiedVehicle& vehicle) {
  ActuatorInput result{.throttle = std::clamp(wanted.throttle, -1.0, 1.0),
                       .steering = std::clamp(wanted.steering, -1.0, 1.0)};
  if (vehicle.steering_rate_per_s) {
    const double most = *vehicle.steering_rate_per_s * kIdentifiedStep_s;
    result.steering = std::clamp(result.steering, last.steering - most, last.steering + most);
  }
  return result;
}

/// p1 (1 + p2 delta^2): speed along the path per speed of the wheels.
[[nodiscard]] inline double path_speed_ratio(double steering, const IdentifiedVehicle& vehicle) {
  const double delta = steering + vehicle.steering_offset;
  return vehicle.path_speed_gain * (1.0 + vehicle.path_speed_steering * delta * delta);
}

/// p3 delta + p10 [rad]: angle from the yaw to the course.
[[nodiscard]] inline double identified_slip_rad(double steering, const IdentifiedVehicle& vehicle) {
  return vehicle.slip_gain_rad * (steering + vehicle.steering_offset) + vehicle.slip_offset_rad;
}

/// p4 v delta [rad/s].
[[nodiscard]] inline double identified_yaw_rate_radps(const VehicleMotion& motion, double steering,
                                                      const IdentifiedVehicle& vehicle) {
  return vehicle.yaw_rate_gain_per_m * motion.speed_mps * (steering + vehicle.steering_offset);
}

/// p5 v + (p6 + p7 V) sign(f) |f|^p8 [m/s^2].
[[nodiscard]] inline double identified_acceleration_mps2(double speed_mps, double throttle,
                                                         const IdentifiedVehicle& vehicle,
                                                         double voltage_v = kBatteryVoltage_v) {
  const double full_thrust_mps2 = vehicle.thrust_offset_mps2 + vehicle.thrust_per_volt * voltage_v;
  return vehicle.drag_per_s * speed_mps +
         full_thrust_mps2 *
             std::copysign(std::pow(std::abs(throttle), vehicle.throttle_exponent), throttle);
}

/// The steering (not clamped) with this slip: the inverse of `identified_slip_rad`.
[[nodiscard]] inline double steering_for_slip(double slip_rad, const IdentifiedVehicle& vehicle) {
  return (slip_rad - vehicle.slip_offset_rad) / vehicle.slip_gain_rad - vehicle.steering_offset;
}

/// Throttle in [-1, 1] whose acceleration is nearest to the given one at this speed.
[[nodiscard]] inline double throttle_for_acceleration(double acceleration_mps2, double speed_mps,
                                                      const IdentifiedVehicle& vehicle,
                                                      double voltage_v = kBatteryVoltage_v) {
  const double full_thrust_mps2 = vehicle.thrust_offset_mps2 + vehicle.thrust_per_volt * voltage_v;
  const double share = (acceleration_mps2 - vehicle.drag_per_s * speed_mps) / full_thrust_mps2;
  const double throttle =
      std::copysign(std::pow(std::abs(share), 1.0 / vehicle.throttle_exponent), share);
  return std::clamp(throttle, -1.0, 1.0);
}

/// One explicit Euler step of `kIdentifiedStep_s` from `motion` with `input` acting.
[[nodiscard]] inline VehicleMotion stepped(const VehicleMotion& motion, const ActuatorInput& input,
                                           const IdentifiedVehicle& vehicle,
                                           double voltage_v = kBatteryVoltage_v) {
  const double path_speed_mps = path_speed_ratio(input.steering, vehicle) * motion.speed_mps;
  const double course_rad = motion.pose.heading_rad + identified_slip_rad(input.steering, vehicle);
  const double yaw_rate_radps = identified_yaw_rate_radps(motion, input.steering, vehicle);
  const double acceleration_mps2 =
      identified_acceleration_mps2(motion.speed_mps, input.throttle, vehicle, voltage_v);
  return {
      .pose = {.x_m = motion.pose.x_m + kIdentifiedStep_s * path_speed_mps * std::cos(course_rad),
               .y_m = motion.pose.y_m + kIdentifiedStep_s * path_speed_mps * std::sin(course_rad),
               .heading_rad = motion.pose.heading_rad + kIdentifiedStep_s * yaw_rate_radps},
      .speed_mps = motion.speed_mps + kIdentifiedStep_s * acceleration_mps2};
}

/// The lab's stop law: steering 0, throttle -0.5 per m/s.
[[nodiscard]] inline ActuatorInput stop_input(double speed_mps) {
  return {.throttle = std::clamp(0.0 - 0.5 * speed_mps, -1.0, 1.0), .steering = 0.0};
}

}  // namespace hlc::vehicle
