#include "vehicle_sim/tracking/command_laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hlc::tracking {
namespace {

constexpr double kServoPerCurvature_m = 0.241857;
constexpr double kFeedForwardGain_s_per_m = 0.152744;
constexpr double kFeedForwardExponent = 0.62791;
constexpr double kSpeedGain_s_per_m = 0.3;
constexpr double kIntegralPerTick_s_per_m = 0.01;
constexpr double kLargestIntegral = 0.5;

constexpr double kWheelbase_m = 0.150;
constexpr double kFrontAxle_m = 0.075;
constexpr double kLargestWheelAngle_rad = 1.0;
constexpr double kStanleyGain_per_s = 2.0;
constexpr double kLeastSpeed_mps = 0.1;
/// Points of a path closer than this coincide.
constexpr double kSamePlace_m = 1e-3;

struct Nearest {
  double distance_m{std::numeric_limits<double>::infinity()};
  Point along{0.0, 0.0};      ///< unit vector of the segment
  Point to_path_m{0.0, 0.0};  ///< from the axle to the path
  bool is_the_end{};          ///< of the last segment
};

}  // namespace

vehicle::ActuatorInput direct_input(const DirectCommand& command) {
  return {.throttle = std::clamp(command.motor_throttle, -1.0, 1.0),
          .steering = std::clamp(command.steering_servo, -1.0, 1.0)};
}

double steering_for_curvature(double curvature_per_m) {
  return std::clamp(kServoPerCurvature_m * curvature_per_m, -1.0, 1.0);
}

double SpeedControl::tick(double wanted_mps, double measured_mps) {
  const double error_mps = wanted_mps - measured_mps;
  integral_ = std::clamp(integral_ + kIntegralPerTick_s_per_m * error_mps, -kLargestIntegral,
                         kLargestIntegral);
  const double feed_forward = std::copysign(
      std::pow(kFeedForwardGain_s_per_m * std::abs(wanted_mps), kFeedForwardExponent), wanted_mps);
  return std::clamp(feed_forward + kSpeedGain_s_per_m * error_mps + integral_, -1.0, 1.0);
}

std::optional<double> steering_for_path(const PathTrackingCommand& command,
                                        const vehicle::VehicleMotion& estimate) {
  const std::vector<PathPoint>& path = command.path;
  const double yaw_rad = estimate.pose.heading_rad;
  const Point axle_m =
      estimate.pose.position_m() + kFrontAxle_m * Point(std::cos(yaw_rad), std::sin(yaw_rad));
  Nearest nearest;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point begin_m = path[i - 1].pose.position_m();
    const Point segment_m = path[i].pose.position_m() - begin_m;
    const double length_m = segment_m.norm();
    if (length_m < kSamePlace_m) continue;
    const double share = (axle_m - begin_m).dot(segment_m) / (length_m * length_m);
    const Point to_path_m = begin_m + std::clamp(share, 0.0, 1.0) * segment_m - axle_m;
    if (to_path_m.norm() < nearest.distance_m) {
      nearest = {.distance_m = to_path_m.norm(),
                 .along = segment_m / length_m,
                 .to_path_m = to_path_m,
                 .is_the_end = i + 1 == path.size() && share >= 1.0};
    }
  }
  if (!std::isfinite(nearest.distance_m)) return std::nullopt;
  const bool is_closed =
      (path.front().pose.position_m() - path.back().pose.position_m()).norm() < kSamePlace_m;
  if (nearest.is_the_end && !is_closed) return std::nullopt;
  const double heading_error_rad =
      wrap_angle(std::atan2(nearest.along.y(), nearest.along.x()) - yaw_rad);
  const Point left{-nearest.along.y(), nearest.along.x()};
  const double lateral_m = left.dot(nearest.to_path_m);
  const double correction_rad =
      std::atan2(kStanleyGain_per_s * lateral_m, std::abs(estimate.speed_mps) + kLeastSpeed_mps);
  const double wheel_rad = std::clamp(heading_error_rad + correction_rad, -kLargestWheelAngle_rad,
                                      kLargestWheelAngle_rad);
  return steering_for_curvature(std::tan(wheel_rad) / kWheelbase_m);
}

}  // namespace hlc::tracking
