#include "vehicle_sim/tracking/follower.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/geometry/cross.hpp"
#include "vehicle_sim/tracking/trajectory.hpp"

namespace hlc::tracking {
namespace {

/// A chord of one tick below this (0.02 mm) is rounding, not a direction.
constexpr double kStandingSpeed_mps = 1e-3;

}  // namespace

bool is_finite(const vehicle::VehicleMotion& motion) {
  return std::isfinite(motion.pose.x_m) && std::isfinite(motion.pose.y_m) &&
         std::isfinite(motion.pose.heading_rad) && std::isfinite(motion.speed_mps);
}

FollowerGains scaled(const FollowerGains& gains, double factor) {
  return {.feed_forward = factor * gains.feed_forward,
          .longitudinal_per_s = factor * gains.longitudinal_per_s,
          .lateral_per_s = factor * gains.lateral_per_s};
}

Follower::Output Follower::tick(Nanoseconds t_now, const vehicle::VehicleMotion& estimate,
                                const TrajectoryCommand* command) {
  const Output output = decide(t_now, estimate, command);
  give(output.input);
  return output;
}

Follower::Output Follower::decide(Nanoseconds t_now, const vehicle::VehicleMotion& estimate,
                                  const TrajectoryCommand* command) const {
  if (!is_finite(estimate)) {
    return {.input = {}, .status = FollowerStatus::kNoEstimate};
  }
  const vehicle::ActuatorInput stop = vehicle::stop_input(estimate.speed_mps);
  if (command == nullptr) {
    return {.input = stop, .status = FollowerStatus::kNoCommand};
  }
  if (!is_followable(command->points, t_now)) {
    return {.input = stop, .status = FollowerStatus::kNotFollowable};
  }

  vehicle::VehicleMotion start = estimate;
  for (const vehicle::ActuatorInput& input : inputs_.under_way()) {
    start = vehicle::stepped(start, input, vehicle_);
  }
  // The lead rule permits a trajectory that begins up to 30 ms after the input acts: use its begin.
  const Nanoseconds t_start =
      std::max(t_now + vehicle::kInputDelayTicks * kVehiclePeriod, command->points.front().t);
  Reference reference;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const std::optional<CurveSample> wanted = sample(command->points, t_start + i * kVehiclePeriod);
    if (!wanted) {
      return {.input = stop, .status = FollowerStatus::kNotFollowable};
    }
    reference[i] = wanted->position_m;
  }
  // At the same time only: a fast vehicle drives more than that in the two ticks after it.
  const double distance_m = (reference.front() - start.pose.position_m()).norm();
  if (!(distance_m <= kMaxDistance_m)) {
    return {.input = stop, .status = FollowerStatus::kTooFar};
  }
  const double steering = steering_for(reference, start);
  const double throttle = throttle_for(reference, start, steering);
  return {.input = {.throttle = throttle, .steering = steering},
          .status = FollowerStatus::kFollowing};
}

double Follower::steering_for(const Reference& reference,
                              const vehicle::VehicleMotion& start) const {
  const Point chord = (reference[1] - reference[0]) / vehicle::kIdentifiedStep_s;
  const double speed_mps = chord.norm();
  if (speed_mps <= kStandingSpeed_mps) {
    return inputs_.last().steering;
  }
  const double lateral_error_m = cross(chord / speed_mps, reference[0] - start.pose.position_m());
  const double correction_rad = std::atan2(gains_.lateral_per_s * lateral_error_m, speed_mps);
  const double course_rad = std::atan2(chord.y(), chord.x()) + correction_rad;
  const double slip_rad = wrap_angle(course_rad - start.pose.heading_rad);
  return std::clamp(vehicle::steering_for_slip(slip_rad, vehicle_), -1.0, 1.0);
}

double Follower::throttle_for(const Reference& reference, const vehicle::VehicleMotion& start,
                              double steering) const {
  // The throttle does not affect the position at the end of this tick, so any value predicts it.
  const vehicle::VehicleMotion end =
      vehicle::stepped(start, {.throttle = 0.0, .steering = steering}, vehicle_);
  const Point error_m = reference[1] - end.pose.position_m();
  const Point chord = (reference[2] - reference[1]) / vehicle::kIdentifiedStep_s;
  const double speed_mps = chord.norm();

  double wanted_mps = 0.0;
  if (speed_mps > kStandingSpeed_mps) {
    const double error_along_m = chord.dot(error_m) / speed_mps;
    wanted_mps = gains_.feed_forward * speed_mps + gains_.longitudinal_per_s * error_along_m;
  } else {
    const double course_rad =
        end.pose.heading_rad + vehicle::identified_slip_rad(steering, vehicle_);
    const double error_along_m = Point(std::cos(course_rad), std::sin(course_rad)).dot(error_m);
    if (error_along_m > kStandingTolerance_m) {
      wanted_mps = gains_.longitudinal_per_s * error_along_m;
    }
  }
  const double wheel_speed_mps =
      std::max(0.0, wanted_mps) / vehicle::path_speed_ratio(steering, vehicle_);
  const double acceleration_mps2 = (wheel_speed_mps - start.speed_mps) / vehicle::kIdentifiedStep_s;
  return vehicle::throttle_for_acceleration(acceleration_mps2, start.speed_mps, vehicle_);
}

}  // namespace hlc::tracking
