#include "hlc_bridge/dds/convert_lab.hpp"

#include <algorithm>
#include <utility>
#include <vector>

// The structured bindings name every field of a plain message, so that a new field does not compile
// until it is converted.
namespace hlc::dds {
namespace {

::Header header(Nanoseconds create_stamp, Nanoseconds valid_after_stamp) {
  ::Header result;
  result.create_stamp().nanoseconds(create_stamp);
  result.valid_after_stamp().nanoseconds(valid_after_stamp);
  return result;
}

::Pose2D lab_pose_to_wire(const Pose& pose) {
  ::Pose2D result;
  result.x(pose.x_m);
  result.y(pose.y_m);
  result.yaw(pose.heading_rad);
  return result;
}

Pose lab_pose_from_wire(const ::Pose2D& wire) { return {wire.x(), wire.y(), wire.yaw()}; }

template <class Message, class Wire>
std::vector<Wire> all_to_wire(const std::vector<Message>& messages) {
  std::vector<Wire> result(messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    to_wire(messages[i], result[i]);
  }
  return result;
}

// The valid ones; the others are counted in `invalid`.
template <class Message, class Wire>
std::vector<Message> valid_ones(const std::vector<Wire>& wire, std::uint64_t& invalid) {
  std::vector<Message> result;
  for (const Wire& entry : wire) {
    const Incoming<Message> incoming = from_wire(entry);
    if (incoming.message) {
      result.push_back(*incoming.message);
    }
    invalid += incoming.invalid;
  }
  return result;
}

}  // namespace

void to_wire(const VehicleState& message, ::VehicleState& wire) {
  const auto& [vehicle_id, create_stamp, valid_after_stamp, pose, ips_update_age,
               odometer_distance_m, imu_acceleration_forward_mps2, imu_acceleration_left_mps2,
               imu_acceleration_up_mps2, imu_yaw_rad, imu_yaw_rate_radps, speed_mps,
               battery_voltage_v, motor_current_a, motor_throttle, steering_servo, is_real] =
      message;
  wire.vehicle_id(vehicle_id);
  wire.header(header(create_stamp, valid_after_stamp));
  wire.pose(lab_pose_to_wire(pose));
  wire.IPS_update_age_nanoseconds(ips_update_age);
  wire.odometer_distance(odometer_distance_m);
  wire.imu_acceleration_forward(imu_acceleration_forward_mps2);
  wire.imu_acceleration_left(imu_acceleration_left_mps2);
  wire.imu_acceleration_up(imu_acceleration_up_mps2);
  wire.imu_yaw(imu_yaw_rad);
  wire.imu_yaw_rate(imu_yaw_rate_radps);
  wire.speed(speed_mps);
  wire.battery_voltage(battery_voltage_v);
  wire.motor_current(motor_current_a);
  wire.motor_throttle(motor_throttle);
  wire.steering_servo(steering_servo);
  wire.is_real(is_real);
}

Incoming<VehicleState> from_wire(const ::VehicleState& wire) {
  const VehicleState message{.vehicle_id = wire.vehicle_id(),
                             .create_stamp = wire.header().create_stamp().nanoseconds(),
                             .valid_after_stamp = wire.header().valid_after_stamp().nanoseconds(),
                             .pose = lab_pose_from_wire(wire.pose()),
                             .ips_update_age = wire.IPS_update_age_nanoseconds(),
                             .odometer_distance_m = wire.odometer_distance(),
                             .imu_acceleration_forward_mps2 = wire.imu_acceleration_forward(),
                             .imu_acceleration_left_mps2 = wire.imu_acceleration_left(),
                             .imu_acceleration_up_mps2 = wire.imu_acceleration_up(),
                             .imu_yaw_rad = wire.imu_yaw(),
                             .imu_yaw_rate_radps = wire.imu_yaw_rate(),
                             .speed_mps = wire.speed(),
                             .battery_voltage_v = wire.battery_voltage(),
                             .motor_current_a = wire.motor_current(),
                             .motor_throttle = wire.motor_throttle(),
                             .steering_servo = wire.steering_servo(),
                             .is_real = wire.is_real()};
  const bool valid =
      is_finite(message.pose) &&
      all_finite(message.odometer_distance_m, message.imu_acceleration_forward_mps2,
                 message.imu_acceleration_left_mps2, message.imu_acceleration_up_mps2,
                 message.imu_yaw_rad, message.imu_yaw_rate_radps, message.speed_mps,
                 message.battery_voltage_v, message.motor_current_a, message.motor_throttle,
                 message.steering_servo);
  return valid_if(valid, message);
}

void to_wire(const VehicleObservation& message, ::VehicleObservation& wire) {
  const auto& [vehicle_id, create_stamp, valid_after_stamp, pose] = message;
  wire.vehicle_id(vehicle_id);
  wire.header(header(create_stamp, valid_after_stamp));
  wire.pose(lab_pose_to_wire(pose));
}

Incoming<VehicleObservation> from_wire(const ::VehicleObservation& wire) {
  const VehicleObservation message{wire.vehicle_id(), wire.header().create_stamp().nanoseconds(),
                                   wire.header().valid_after_stamp().nanoseconds(),
                                   lab_pose_from_wire(wire.pose())};
  return valid_if(is_finite(message.pose), message);
}

void to_wire(const VehicleStateList& message, ::VehicleStateList& wire) {
  const auto& [t_now, period_ms, states, observations, active_vehicle_ids] = message;
  wire.t_now(t_now);
  wire.period_ms(period_ms);
  wire.state_list(all_to_wire<VehicleState, ::VehicleState>(states));
  wire.vehicle_observation_list(
      all_to_wire<VehicleObservation, ::VehicleObservation>(observations));
  wire.active_vehicle_ids(active_vehicle_ids);
}

Incoming<VehicleStateList> from_wire(const ::VehicleStateList& wire) {
  std::vector<std::int32_t> ids = wire.active_vehicle_ids();
  const bool valid = wire.period_ms() > 0 && wire.state_list().size() <= kMaxEntries &&
                     wire.vehicle_observation_list().size() <= kMaxEntries &&
                     ids.size() <= kMaxEntries;
  if (!valid) {
    return {std::nullopt, 1};
  }
  Incoming<VehicleStateList> result;
  result.invalid = std::erase_if(ids, [](std::int32_t id) { return id < 1 || id > 255; });
  result.message = VehicleStateList{
      wire.t_now(), wire.period_ms(), valid_ones<VehicleState>(wire.state_list(), result.invalid),
      valid_ones<VehicleObservation>(wire.vehicle_observation_list(), result.invalid),
      std::move(ids)};
  return result;
}

void to_wire(const TrajectoryCommand& message, ::VehicleCommandTrajectory& wire) {
  const auto& [vehicle_id, create_stamp, valid_after_stamp, points] = message;
  wire.vehicle_id(vehicle_id);
  wire.header(header(create_stamp, valid_after_stamp));
  wire.trajectory_points().clear();
  for (const auto& [t, x_m, y_m, vx_mps, vy_mps] : points) {
    ::TrajectoryPoint point;
    point.t().nanoseconds(t);
    point.px(x_m);
    point.py(y_m);
    point.vx(vx_mps);
    point.vy(vy_mps);
    wire.trajectory_points().push_back(point);
  }
}

Incoming<TrajectoryCommand> from_wire(const ::VehicleCommandTrajectory& wire) {
  if (wire.trajectory_points().size() > kMaxEntries) {
    return {std::nullopt, 1};
  }
  TrajectoryCommand message{wire.vehicle_id(),
                            wire.header().create_stamp().nanoseconds(),
                            wire.header().valid_after_stamp().nanoseconds(),
                            {}};
  for (const ::TrajectoryPoint& point : wire.trajectory_points()) {
    message.points.push_back(
        {point.t().nanoseconds(), point.px(), point.py(), point.vx(), point.vy()});
  }
  const bool valid = std::ranges::all_of(message.points, [](const TrajectoryPoint& point) {
    return all_finite(point.x_m, point.y_m, point.vx_mps, point.vy_mps);
  });
  return valid_if(valid, message);
}

void to_wire(const PathTrackingCommand& message, ::VehicleCommandPathTracking& wire) {
  const auto& [vehicle_id, create_stamp, valid_after_stamp, path, speed_mps] = message;
  wire.vehicle_id(vehicle_id);
  wire.header(header(create_stamp, valid_after_stamp));
  wire.path().clear();
  for (const auto& [pose, s_m] : path) {
    ::PathPoint point;
    point.pose(lab_pose_to_wire(pose));
    point.s(s_m);
    wire.path().push_back(point);
  }
  wire.speed(speed_mps);
}

Incoming<PathTrackingCommand> from_wire(const ::VehicleCommandPathTracking& wire) {
  if (wire.path().size() > kMaxEntries) {
    return {std::nullopt, 1};
  }
  PathTrackingCommand message{wire.vehicle_id(),
                              wire.header().create_stamp().nanoseconds(),
                              wire.header().valid_after_stamp().nanoseconds(),
                              {},
                              wire.speed()};
  for (const ::PathPoint& point : wire.path()) {
    message.path.push_back({lab_pose_from_wire(point.pose()), point.s()});
  }
  const bool valid = std::isfinite(message.speed_mps) &&
                     std::ranges::all_of(message.path, [](const PathPoint& point) {
                       return is_finite(point.pose) && std::isfinite(point.s_m);
                     });
  return valid_if(valid, message);
}

void to_wire(const SpeedCurvatureCommand& message, ::VehicleCommandSpeedCurvature& wire) {
  const auto& [vehicle_id, create_stamp, valid_after_stamp, speed_mps, curvature_per_m] = message;
  wire.vehicle_id(vehicle_id);
  wire.header(header(create_stamp, valid_after_stamp));
  wire.speed(speed_mps);
  wire.curvature(curvature_per_m);
}

Incoming<SpeedCurvatureCommand> from_wire(const ::VehicleCommandSpeedCurvature& wire) {
  const SpeedCurvatureCommand message{wire.vehicle_id(), wire.header().create_stamp().nanoseconds(),
                                      wire.header().valid_after_stamp().nanoseconds(), wire.speed(),
                                      wire.curvature()};
  return valid_if(all_finite(message.speed_mps, message.curvature_per_m), message);
}

void to_wire(const DirectCommand& message, ::VehicleCommandDirect& wire) {
  const auto& [vehicle_id, create_stamp, valid_after_stamp, motor_throttle, steering_servo] =
      message;
  wire.vehicle_id(vehicle_id);
  wire.header(header(create_stamp, valid_after_stamp));
  wire.motor_throttle(motor_throttle);
  wire.steering_servo(steering_servo);
}

Incoming<DirectCommand> from_wire(const ::VehicleCommandDirect& wire) {
  const DirectCommand message{wire.vehicle_id(), wire.header().create_stamp().nanoseconds(),
                              wire.header().valid_after_stamp().nanoseconds(),
                              wire.motor_throttle(), wire.steering_servo()};
  return valid_if(all_finite(message.motor_throttle, message.steering_servo), message);
}

}  // namespace hlc::dds
