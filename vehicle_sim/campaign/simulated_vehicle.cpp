#include "vehicle_sim/campaign/simulated_vehicle.hpp"

namespace hlc {
namespace {

static_assert(kVehiclePeriod == 20'000'000 && kIdentifiedStep_s == 0.020,
              "one tick of the vehicle is one step of the model");

constexpr double kGravity_mps2 = 9.81;

VehicleState state_message(std::uint8_t vehicle_id, Nanoseconds t_now,
                           const VehicleMotion& estimate, const Measurement& measured,
                           const ActuatorInput& commanded) {
  VehicleState state;
  state.vehicle_id = vehicle_id;
  state.create_stamp = t_now;
  state.valid_after_stamp = t_now + kStateDelay;
  state.pose = estimate.pose;
  state.odometer_distance_m = measured.odometer_m;
  state.imu_acceleration_forward_mps2 = measured.acceleration_forward_mps2;
  state.imu_acceleration_left_mps2 = measured.acceleration_left_mps2;
  state.imu_acceleration_up_mps2 = kGravity_mps2;
  state.imu_yaw_rad = estimate.pose.heading_rad;
  state.imu_yaw_rate_radps = measured.yaw_rate_radps;
  state.speed_mps = measured.speed_mps;
  state.battery_voltage_v = kBatteryVoltage_v;
  state.motor_throttle = commanded.throttle;
  state.steering_servo = commanded.steering;
  return state;
}

}  // namespace

SimulatedVehicle::SimulatedVehicle(const SimulatedVehicleOptions& options)
    : vehicle_id_(options.vehicle_id),
      plant_({.start = options.start,
              .vehicle = options.vehicle,
              .battery_voltage_v = kBatteryVoltage_v,
              .noise_seed = options.noise_seed}),
      estimator_(options.vehicle),
      follower_(options.gains, options.vehicle) {}

SimulatedVehicle::Tick SimulatedVehicle::tick(Nanoseconds t_now) {
  const VehicleMotion truth = plant_.motion();
  const Measurement measured = plant_.measure();
  const VehicleMotion estimate =
      estimator_.update(measured.pose, measured.speed_mps, follower_.acted());

  const TrajectoryCommand* command = is_braking() ? nullptr : commands_.usable_at(t_now);
  const Follower::Output output = follower_.tick(t_now, estimate, command);
  const bool follows = output.status == FollowerStatus::kFollowing;
  Tick result{.state = state_message(vehicle_id_, t_now, estimate, measured, output.input),
              .driven = {.t = t_now,
                         .pose = truth.pose,
                         .speed_mps = truth.speed_mps,
                         .throttle = output.input.throttle,
                         .steering = output.input.steering,
                         .command_create = follows ? command->create_stamp : 0},
              .status = output.status};

  plant_.step(output.input);
  if (is_braking() && --braking_ticks_left_ == 0) {
    commands_.clear();
  }
  return result;
}

}  // namespace hlc
