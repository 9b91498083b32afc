#pragma once

#include <cstdint>
#include <optional>

#include "planner/vehicle/delayed_inputs.hpp"
#include "vehicle_sim/plant/uniform_noise.hpp"

namespace hlc::plant {

/// Parameters of one simulated vehicle.
struct PlantOptions {
  Pose start;  ///< pose at the first tick; finite
  vehicle::IdentifiedVehicle vehicle;
  double battery_voltage_v{vehicle::kBatteryVoltage_v};
  /// Seed of the position noise; without one the pose is measured exactly.
  std::optional<std::uint64_t> noise_seed;
};

/// Half widths of the uniform noise on a measured pose: the lab's camera system.
inline constexpr double kPositionNoise_m = 0.002;
inline constexpr double kHeadingNoise_rad = 0.010;

/// Sensor values at a tick. Only the pose is noisy.
struct Measurement {
  Pose pose;
  double speed_mps{};
  double odometer_m{};
  double yaw_rate_radps{};
  double acceleration_forward_mps2{};
  double acceleration_left_mps2{};
};

/// One simulated vehicle: the identified model behind an actuator with a delay. For another car
/// than the lab's the model is made of its limits (vehicle::kinematic_vehicle).
///
/// At every tick: first `measure`, then `step` with the input that was computed from it. An input
/// given at tick n acts from tick n + 4 to n + 5; before the fifth input the actuators rest at 0.
/// The model is integrated by explicit Euler with 20 ms (`planner/vehicle/identified_motion.hpp`),
/// the step with which its parameters were identified: a finer integration would be another
/// vehicle.
///
/// A value: copies are independent, and equal options and inputs give equal bytes.
class Plant {
 public:
  /// @throws std::invalid_argument if the start pose is not finite
  explicit Plant(const PlantOptions& options);

  /// True pose and speed at the current tick.
  [[nodiscard]] const vehicle::VehicleMotion& motion() const { return motion_; }

  /// The sensors at the current tick. With noise every call draws again: call it once per tick.
  [[nodiscard]] Measurement measure();

  /// Queues `commanded` and advances one tick with the input that has reached the actuators. Inputs
  /// beyond what the actuators can do are limited (vehicle::actuated); one that is not finite
  /// counts as the stop law at the current speed.
  void step(const vehicle::ActuatorInput& commanded);

 private:
  vehicle::IdentifiedVehicle vehicle_;
  double battery_voltage_v_;
  vehicle::VehicleMotion motion_;
  vehicle::DelayedInputs inputs_;
  vehicle::ActuatorInput acting_;  ///< during the last step
  double last_acceleration_mps2_{};
  double odometer_m_{};
  std::optional<UniformNoise> noise_;
};

}  // namespace hlc::plant
