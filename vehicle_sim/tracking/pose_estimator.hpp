#pragma once

#include <optional>

#include "planner/vehicle/identified_motion.hpp"

namespace hlc::tracking {

/// Smooths the measured pose with the model: predict one tick with the input that acted, then
/// correct by `kCorrection` of the difference to the measurement. The lab's vehicle does the same
/// with 0.3.
///
/// Exact measurements of a vehicle that moves by the model stay exact, bit for bit. Noise of
/// standard deviation s leaves s sqrt(a / (2 - a)) = 0.42 s for a = 0.3. The speed is taken as
/// measured.
class PoseEstimator {
 public:
  static constexpr double kCorrection = 0.3;

  explicit PoseEstimator(const vehicle::IdentifiedVehicle& vehicle) : vehicle_(vehicle) {}

  /// Once per tick. The first call takes the measurement as it is.
  /// @param measured_pose       pose from outside, at this tick
  /// @param measured_speed_mps  speed of the wheels at this tick
  /// @param acted               the input that acted from the last tick to this one
  vehicle::VehicleMotion update(const Pose& measured_pose, double measured_speed_mps,
                                const vehicle::ActuatorInput& acted);

 private:
  vehicle::IdentifiedVehicle vehicle_;
  std::optional<vehicle::VehicleMotion> estimate_;
};

}  // namespace hlc::tracking
