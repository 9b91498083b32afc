#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

namespace hlc::simulated_vehicle {
namespace {

static_assert(kVehiclePeriod == 20'000'000 && vehicle::kIdentifiedStep_s == 0.020,
              "one tick of the vehicle is one step of the model");

constexpr double kGravity_mps2 = 9.81;

VehicleState state_message(std::uint8_t vehicle_id, Nanoseconds t_now,
                           const vehicle::VehicleMotion& estimate,
                           const plant::Measurement& measured,
                           const vehicle::ActuatorInput& commanded) {
  VehicleState state;
  state.vehicle_id = vehicle_id;
  state.create_stamp = t_now;
  state.valid_after_stamp = t_now + kStateDelay;
  state.pose = estimate.pose;
  state.ips_update_age = 0;  // measured in this tick
  state.odometer_distance_m = measured.odometer_m;
  state.imu_acceleration_forward_mps2 = measured.acceleration_forward_mps2;
  state.imu_acceleration_left_mps2 = measured.acceleration_left_mps2;
  state.imu_acceleration_up_mps2 = kGravity_mps2;
  state.imu_yaw_rad = estimate.pose.heading_rad;
  state.imu_yaw_rate_radps = measured.yaw_rate_radps;
  state.speed_mps = measured.speed_mps;
  state.battery_voltage_v = vehicle::kBatteryVoltage_v;
  state.motor_throttle = commanded.throttle;
  state.steering_servo = commanded.steering;
  return state;
}

}  // namespace

SimulatedVehicle::SimulatedVehicle(const SimulatedVehicleOptions& options)
    : vehicle_id_(options.vehicle_id),
      plant_({.start = options.start,
              .vehicle = options.vehicle,
              .battery_voltage_v = vehicle::kBatteryVoltage_v,
              .noise_seed = options.noise_seed}),
      estimator_(options.vehicle),
      follower_(options.gains, options.vehicle) {
  if (options.driver) driver_.emplace(*options.driver);
  if (options.stamps == Stamps::kLab) {
    lab_follower_.emplace(options.vehicle);
    measure();
  }
}

void SimulatedVehicle::measure() {
  measured_ = plant_.measure();
  estimate_ = estimator_.update(measured_.pose, measured_.speed_mps, follower_.acted());
}

SimulatedVehicle::Tick SimulatedVehicle::tick(Nanoseconds t_now) {
  const vehicle::VehicleMotion truth = plant_.motion();
  const bool moves_first = lab_follower_.has_value();
  if (!moves_first) measure();
  if (driver_) {
    std::visit([this](const auto& command) { receive(command); }, driver_->tick(t_now, truth));
  }
  const Decision decision = decide(t_now);
  follower_.give(decision.input);
  if (moves_first) {
    lab_follower_->give(decision.input);
    plant_.step(decision.input);
    measure();
  }
  const bool follows = decision.status == tracking::FollowerStatus::kFollowing;
  Tick result{.state = state_message(vehicle_id_, t_now, estimate_, measured_, decision.input),
              .observation = {.vehicle_id = vehicle_id_,
                              .create_stamp = t_now,
                              .valid_after_stamp = t_now,
                              .pose = measured_.pose},
              .driven = {.t = t_now,
                         .pose = truth.pose,
                         .speed_mps = truth.speed_mps,
                         .throttle = decision.input.throttle,
                         .steering = decision.input.steering,
                         .command_create = follows ? decision.command_create : 0},
              .status = decision.status};
  if (!moves_first) plant_.step(decision.input);
  if (is_braking() && --braking_ticks_left_ == 0) {
    std::apply([](auto&... buffers) { (buffers.clear(), ...); }, commands_);
  }
  return result;
}

tracking::Follower::Output SimulatedVehicle::follow(Nanoseconds t_now,
                                                    const TrajectoryCommand* command) {
  return lab_follower_ ? lab_follower_->decide(t_now, estimate_, command)
                       : follower_.decide(t_now, estimate_, command);
}

SimulatedVehicle::Decision SimulatedVehicle::decide(Nanoseconds t_now) {
  // All buffers are queried at every tick: a command that is not queried while it is valid would
  // count as new when one of higher rank has expired.
  const auto usable = std::apply(
      [&](auto&... buffers) { return std::tuple{buffers.usable_at(t_now)...}; }, commands_);
  const auto& [direct, speed_curvature, trajectory, path] = usable;
  const tracking::Follower::Output followed = follow(t_now, is_braking() ? nullptr : trajectory);
  const bool has_estimate = followed.status != tracking::FollowerStatus::kNoEstimate;
  if (has_estimate && !is_braking()) {
    if (direct != nullptr) {
      speed_control_.reset();
      return {tracking::direct_input(*direct), tracking::FollowerStatus::kFollowing,
              direct->create_stamp};
    }
    if (speed_curvature != nullptr) {
      return {{.throttle = speed_control_.tick(speed_curvature->speed_mps, estimate_.speed_mps),
               .steering = tracking::steering_for_curvature(speed_curvature->curvature_per_m)},
              tracking::FollowerStatus::kFollowing,
              speed_curvature->create_stamp};
    }
    if (trajectory == nullptr && path != nullptr) {
      if (const auto steering = tracking::steering_for_path(*path, estimate_)) {
        return {{.throttle = speed_control_.tick(path->speed_mps, estimate_.speed_mps),
                 .steering = *steering},
                tracking::FollowerStatus::kFollowing,
                path->create_stamp};
      }
    }
  }
  speed_control_.reset();
  return {followed.input, followed.status,
          trajectory != nullptr ? trajectory->create_stamp : Nanoseconds{}};
}

}  // namespace hlc::simulated_vehicle
