#include "vehicle_sim/plant/plant.hpp"

#include <cmath>
#include <stdexcept>

namespace hlc::plant {
namespace {

bool is_finite(const vehicle::ActuatorInput& input) {
  return std::isfinite(input.throttle) && std::isfinite(input.steering);
}

}  // namespace

Plant::Plant(const PlantOptions& options)
    : vehicle_(options.vehicle),
      battery_voltage_v_(options.battery_voltage_v),
      motion_{.pose = options.start, .speed_mps = 0.0} {
  if (!std::isfinite(options.start.x_m) || !std::isfinite(options.start.y_m) ||
      !std::isfinite(options.start.heading_rad)) {
    throw std::invalid_argument("start pose of a simulated vehicle: x, y and yaw must be finite");
  }
  if (options.noise_seed) {
    noise_.emplace(*options.noise_seed);
  }
}

Measurement Plant::measure() {
  const double yaw_rate_radps =
      vehicle::identified_yaw_rate_radps(motion_, acting_.steering, vehicle_);
  Measurement measurement{.pose = motion_.pose,
                          .speed_mps = motion_.speed_mps,
                          .odometer_m = odometer_m_,
                          .yaw_rate_radps = yaw_rate_radps,
                          .acceleration_forward_mps2 = last_acceleration_mps2_,
                          .acceleration_left_mps2 = motion_.speed_mps * yaw_rate_radps};
  if (noise_) {
    measurement.pose.x_m += noise_->draw(kPositionNoise_m);
    measurement.pose.y_m += noise_->draw(kPositionNoise_m);
    measurement.pose.heading_rad += noise_->draw(kHeadingNoise_rad);
  }
  return measurement;
}

void Plant::step(const vehicle::ActuatorInput& commanded) {
  acting_ = inputs_.give(is_finite(commanded) ? commanded : vehicle::stop_input(motion_.speed_mps),
                         vehicle_);

  const vehicle::VehicleMotion before = motion_;
  motion_ = vehicle::stepped(before, acting_, vehicle_, battery_voltage_v_);
  last_acceleration_mps2_ = (motion_.speed_mps - before.speed_mps) / vehicle::kIdentifiedStep_s;
  odometer_m_ += vehicle::kIdentifiedStep_s * std::abs(before.speed_mps);
}

}  // namespace hlc::plant
