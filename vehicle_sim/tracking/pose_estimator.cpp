#include "vehicle_sim/tracking/pose_estimator.hpp"

namespace hlc::tracking {

vehicle::VehicleMotion PoseEstimator::update(const Pose& measured_pose, double measured_speed_mps,
                                             const vehicle::ActuatorInput& acted) {
  if (!estimate_) {
    estimate_ = vehicle::VehicleMotion{.pose = measured_pose, .speed_mps = measured_speed_mps};
    return *estimate_;
  }
  Pose pose = vehicle::stepped(*estimate_, acted, vehicle_).pose;
  pose.x_m += kCorrection * (measured_pose.x_m - pose.x_m);
  pose.y_m += kCorrection * (measured_pose.y_m - pose.y_m);
  pose.heading_rad += kCorrection * wrap_angle(measured_pose.heading_rad - pose.heading_rad);
  estimate_ = vehicle::VehicleMotion{.pose = pose, .speed_mps = measured_speed_mps};
  return *estimate_;
}

}  // namespace hlc::tracking
